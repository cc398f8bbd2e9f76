#include <turnscan/workflow/page/turn_points.hpp>

#include <algorithm>
#include <cmath>

namespace turnscan {

std::vector<TurnPoint> turn_of(const FrameSequence& sequence) {
  std::vector<TurnPoint> turn;
  const auto& frames = sequence.frames();
  for (const FrameInfo& f : frames) {
    const bool first = f.sensor == frames.front().sensor && f.pass == frames.front().pass;
    if (first && f.status == FrameStatus::kOk && f.angle_rad && std::isfinite(f.time_s))
      turn.push_back({f.time_s, *f.angle_rad});
  }
  std::stable_sort(turn.begin(), turn.end(),
                   [](const TurnPoint& a, const TurnPoint& b) { return a.time_s < b.time_s; });
  return turn;
}

}  // namespace turnscan
