#pragma once
// Reports slips and stops of a recording's table as findings.

#include <turnscan/turntable/checks/check.hpp>

namespace turnscan::checks {

/// found: the calibration from the recording's motion; the object's shape must determine its
/// rotation. Empty if the frames have no times. If every frame has a recorded angle, those angles
/// may already follow the events. Fails with kCancelled and with the errors of reading.
Result<std::vector<Finding>> check_motor(const FrameSequence& sequence, const CheckOptions& options,
                                         const Calibration& found, const RunContext& context);

}  // namespace turnscan::checks
