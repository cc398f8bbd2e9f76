#pragma once
// Is the calibration of a recording right, and if not, what is wrong?

#include <string>
#include <turnscan/turntable/checks/closure.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>

namespace turnscan {

enum class Rating { kGood, kNotKnown, kWrong };

/// The result of one check.
struct Finding {
  Rating rating = Rating::kGood;
  std::string text;  ///< one sentence
};

/// Of a check that could be made.
constexpr Rating rating_of(bool good) { return good ? Rating::kGood : Rating::kWrong; }

struct CheckOptions {
  FromMotionOptions motion;
  DetectOptions detect;
};

/// Checks closure, direction, speed, recorded angles, slips and stops, and drift of what stands
/// still. What cannot be checked is said, too. Fails with kCancelled and what reading
/// fails with.
Result<std::vector<Finding>> check_recording(const FrameSequence& sequence,
                                             const CheckOptions& options,
                                             const RunContext& context);

}  // namespace turnscan
