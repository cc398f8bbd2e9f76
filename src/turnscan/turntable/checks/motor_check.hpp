#pragma once
// Slips and stops of a recording's table, in sentences.

#include <turnscan/turntable/checks/check.hpp>

namespace turnscan::checks {

/// found: the calibration from the recording's motion, which must show the object's turn. Nothing
/// where the frames have no times. Recorded angles, where every frame has one, may have followed
/// the events. Fails with kCancelled and what reading fails with.
Result<std::vector<Finding>> check_motor(const FrameSequence& sequence, const CheckOptions& options,
                                         const Calibration& found, const RunContext& context);

}  // namespace turnscan::checks
