#pragma once
// Which calibration a reconstruction uses.

#include <string>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::cli {

struct CalibrationChoice {
  std::optional<Calibration> calibration;  ///< nullopt: the recording's own
  std::vector<Pose> poses;                 ///< of the frames, by free registration; else empty
  std::string note;                        ///< one sentence for people; empty: nothing to say
};

struct CalibrationWish {
  std::string mode = "auto";
  std::optional<double> speed_rad_s;  ///< that somebody stated; it is not questioned
  bool table_given = false;           ///< that somebody gave; its place is not questioned
};

/// mode "recorded" keeps the recording's calibration, "motion" makes one from motion, "auto" does
/// that where the recording has none, or one whose closure error is bad (turntable/check.hpp).
/// icp-consecutive, icp-global, gicp-consecutive and gicp-global start from the recording's and
/// register the frames freely (turntable/free_motion.hpp).
/// Fails with kInvalidOption for another mode, with kMissingData when there is no calibration and
/// none can be made, kCancelled, and what reading fails with.
Result<CalibrationChoice> choose_calibration(const FrameSequence& sequence,
                                             const CalibrationWish& wish,
                                             const RunContext& context);

/// The sequence as the choice shows it; it must outlive the result.
Result<std::unique_ptr<FrameSequence>> with_choice(const FrameSequence& sequence,
                                                   const CalibrationChoice& choice);

}  // namespace turnscan::cli
