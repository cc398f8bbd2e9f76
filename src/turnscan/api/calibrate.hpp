#pragma once
// Where the turntable stands and how it turns: what `turnscan calibrate` does.
// recording/calibration_file.hpp reads and writes the result.

#include <turnscan/api/options.hpp>
#include <turnscan/core/calibration.hpp>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

/// Determines axis and centre of the turntable in the frame of sensor 0, and the angle of each
/// frame, from the motion of the object. Where no motion can be seen, it fits the platter's surface
/// and rim instead, which gives no angles. with_calibration() (core/calibration.hpp) applies the
/// result to the frames.
///
/// The options are those of `turnscan calibrate`: `from-motion` and `detect` demand one of the two
/// ways, `points` names a file of points picked on the rim.
///
/// Fails with kInvalidOption, kMissingData (the turntable cannot be found), kFormat (a file that an
/// option names), kCancelled, and as reading frames does.
Result<Calibration> calibrate(const FrameSequence& frames, const Options& options = {},
                              const RunContext& context = {});

/// The options of calibrate().
std::vector<OptionDescription> calibrate_options();

}  // namespace turnscan
