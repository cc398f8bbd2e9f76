#pragma once

#include <memory>
#include <string>
#include <turnscan/core/frame.hpp>

namespace turnscan {

/// The sequence seen with another turntable: a file that turnscan calibrate saved, or a JSON object
/// as the key "turntable" of recording.json (axis, center_m, and perhaps radius_m, speed_rad_s),
/// alone or under that key. Sensor 0 gets its place from it. An empty path keeps the recording's
/// turntable. The sequence must outlive the result. Fails as read_calibration() and
/// with_calibration().
Result<std::unique_ptr<FrameSequence>> with_turntable(const FrameSequence& sequence,
                                                      const std::string& path);

}  // namespace turnscan
