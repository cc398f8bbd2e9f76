#include <turnscan/core/frame_samples.hpp>

namespace turnscan {

std::vector<std::size_t> usable_frames(const FrameSequence& sequence, const FrameFilter& filter) {
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const FrameInfo& info = sequence.frames()[i];
    if (info.status == FrameStatus::kOk && info.sensor == filter.sensor.value_or(info.sensor) &&
        info.pass == filter.pass.value_or(info.pass))
      positions.push_back(i);
  }
  return positions;
}

}  // namespace turnscan
