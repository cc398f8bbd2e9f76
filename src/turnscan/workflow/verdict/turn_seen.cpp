#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/verdict/turn_seen.hpp>

namespace turnscan {

namespace {

constexpr double kHeadingReach_rad = 20.0 * kRadiansPerDegree;

}  // namespace

std::optional<TurnSeen> turn_seen(const FrameSequence& frames, std::optional<double> speed_rad_s) {
  const auto poses = frame_poses(frames.header(), frames.frames(), speed_rad_s);
  if (!poses) return std::nullopt;
  std::vector<double> headings;
  TurnSeen out;
  std::optional<double> before;
  for (std::size_t i = 0; i < poses->T_table_sensor.size(); ++i) {
    if (frames.frames()[i].status != FrameStatus::kOk) continue;
    const Vec3d at = poses->T_table_sensor[i].translation();
    const double heading = std::atan2(at.z(), at.x());
    headings.push_back(heading);
    if (before) out.turns += std::abs(std::remainder(heading - *before, kTurn)) / kTurn;
    before = heading;
  }
  if (headings.empty()) return std::nullopt;
  std::sort(headings.begin(), headings.end());
  double unseen = 0.0;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    const double next = i + 1 < headings.size() ? headings[i + 1] : headings[0] + kTurn;
    const double gap = next - headings[i];
    unseen += std::max(0.0, gap - 2.0 * kHeadingReach_rad);
    out.widest_gap_rad = std::max(out.widest_gap_rad, gap);
  }
  out.share = 1.0 - unseen / kTurn;
  return out;
}

}  // namespace turnscan
