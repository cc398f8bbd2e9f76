#pragma once
// Checks the calibration of a recording and reports what is wrong with it.

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

/// Rating of a check that could be made.
constexpr Rating rating_of(bool good) { return good ? Rating::kGood : Rating::kWrong; }

struct CheckOptions {
  FromMotionOptions motion;
  DetectOptions detect;
};

/// Checks closure, direction, speed, recorded angles, slips and stops, and drift of the static
/// scene. Checks that could not be made are reported, too. Fails with kCancelled and with the
/// errors of reading.
Result<std::vector<Finding>> check_recording(const FrameSequence& sequence,
                                             const CheckOptions& options,
                                             const RunContext& context);

}  // namespace turnscan
