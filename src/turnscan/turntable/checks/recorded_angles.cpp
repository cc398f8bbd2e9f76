#include <cmath>
#include <turnscan/turntable/checks/recorded_angles.hpp>

namespace turnscan::checks {

std::vector<double> recorded_angles(const FrameSequence& sequence) {
  const auto& table = sequence.header().turntable;
  std::vector<double> out;
  for (const FrameInfo& frame : sequence.frames()) {
    double angle = frame.angle_rad.value_or(std::nan(""));
    if (!frame.angle_rad && table && table->speed_rad_s)
      angle = *table->speed_rad_s * (frame.time_s - sequence.frames().front().time_s);
    out.push_back(frame.status == FrameStatus::kOk && frame.sensor == 0 ? angle : std::nan(""));
  }
  return out;
}

}  // namespace turnscan::checks
