#pragma once

#include <memory>
#include <string>
#include <turnscan/core/frame.hpp>

namespace turnscan {

/// The sequence with another turntable: from a file that turnscan calibrate saved, or from a JSON
/// object like the key "turntable" of recording.json (axis, center_m, and optionally radius_m,
/// speed_rad_s), alone or under that key. It determines the pose of sensor 0. An empty path keeps
/// the recording's turntable. The sequence must outlive the result. Fails as read_calibration() and
/// with_calibration().
Result<std::unique_ptr<FrameSequence>> with_turntable(const FrameSequence& sequence,
                                                      const std::string& path);

}  // namespace turnscan
