#include <algorithm>
#include <cmath>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/placement/hidden_frames.hpp>

namespace turnscan::placement {

namespace {

/// Excess over a typical frame from which a frame is excluded: as share of its points, and in
/// spreads.
constexpr double kMinHidden = 0.25, kSpreads = 6.0;
/// A point counts if the neighbour's surface is this much farther away.
constexpr double kGap_m = 0.012, kNoises = 6.0;
/// And if there is no nearer surface within this many pixels: thin parts lose the mixed pixels of
/// their outline, more of them if the sensor has a spatial filter (drop_outline).
constexpr int kBeside = 3, kBesideFiltered = 6;

/// Whether the ray through q continues for a gap before it meets the surface, or misses it, and
/// nothing beside the platter occludes it.
bool seen_through(const Keyframes& frames, const motion::FrameSurface& surface, const Vec3d& q,
                  double gap) {
  const Eigen::Vector2d uv = frames.data.camera.project(q);
  const auto& camera = frames.data.camera;
  if (!(uv.x() > 0.0 && uv.y() > 0.0 && uv.x() < camera.width - 1 && uv.y() < camera.height - 1))
    return false;
  const int x = int(std::lround(uv.x())) - surface.left, y = int(std::lround(uv.y())) - surface.top;
  const int beside = frames.data.correlated_noise ? kBesideFiltered : kBeside;
  const int top = std::max(0, y - beside), bottom = std::min(surface.height - 1, y + beside);
  const int left = std::max(0, x - beside), right = std::min(surface.width - 1, x + beside);
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const auto i = std::size_t(v) * std::size_t(surface.width) + std::size_t(u);
      if (surface.z[i] > 0.0f && surface.z[i] < q.z() + gap) return false;
      if (!surface.covered.empty() && surface.covered[i] != 0) return false;
    }
  }
  return true;
}

double share_seen_through(const Keyframes& frames, const std::vector<Pose>& poses,
                          const FramePair& pair) {
  const Pose T = poses[pair.to].inverse() * poses[pair.from];
  const motion::FrameSurface& surface = frames.data.frames[pair.to].surface;
  const auto& samples = frames.data.frames[pair.from].samples;
  const double gap = std::max(kGap_m, kNoises * frames.data.noise_m);
  double through = 0.0, count = 0.0;
  for (std::size_t s = 0; s < samples.size(); s += 2) {
    const Vec3d q = T * samples[s].p.cast<double>();
    const Vec3d m = T.linear() * samples[s].n.cast<double>();
    if (-m.dot(q) < 0.25 * q.norm()) continue;
    count += 1.0;
    if (seen_through(frames, surface, q, gap)) through += 1.0;
  }
  return count > 0.0 ? through / count : 0.0;
}

}  // namespace

std::vector<std::size_t> hidden_frames(const Keyframes& frames, const std::vector<Pose>& poses) {
  if (!frames.data.projective) return {};
  // An occluder in front of the object is seen, too: a frame with few points is a plate seen edge
  // on, whose neighbours see past most of them.
  std::vector<double> counts;
  for (const auto& frame : frames.data.frames) counts.push_back(double(frame.samples.size()));
  const double usual_count = std::max(1.0, median(counts));
  std::vector<double> share(frames.size(), 0.0);
  parallel_for(frames.size(), 1, [&](std::size_t i) {
    std::vector<double> shares;
    for (const int step : {-8, -4, -2, 2, 4, 8}) {
      const auto k = std::ptrdiff_t(i) + step;
      if (k < 0 || k >= std::ptrdiff_t(frames.size())) continue;
      if (frames.data.frames[std::size_t(k)].surface.empty()) continue;
      if (std::abs(turn_between(poses[i], poses[std::size_t(k)])) > 0.9) continue;
      shares.push_back(share_seen_through(frames, poses, {std::uint32_t(i), std::uint32_t(k)}));
    }
    const double points = double(frames.data.frames[i].samples.size());
    share[i] = median(shares) * std::min(1.0, points / usual_count);
  });
  std::vector<double> sorted = share;
  const double usual = median(sorted);
  std::vector<double> off;
  for (const double s : share) off.push_back(std::abs(s - usual));
  const double limit =
      usual + std::max(kMinHidden, kSpreads * estimation::kMadToSigma * median(off));
  // A single one is a view that has little in common with its neighbours, as a plate seen edge on.
  const auto over = [&](std::size_t i) { return i < share.size() && share[i] > limit; };
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < share.size(); ++i)
    if (over(i) && (over(i + 1) || (i > 0 && over(i - 1)))) out.push_back(i);
  return out;
}

void leave_out(Keyframes& frames, const std::vector<std::size_t>& hidden) {
  Keyframes kept;
  const auto is_hidden = [&](std::size_t i) {
    return std::binary_search(hidden.begin(), hidden.end(), i);
  };
  std::vector<motion::MotionFrame> all = std::move(frames.data.frames);
  frames.data.frames.clear();
  frames.data.keys.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_hidden(i)) continue;
    frames.data.keys.push_back(frames.data.frames.size());
    frames.data.frames.push_back(std::move(all[i]));
    kept.positions.push_back(frames.positions[i]);
    kept.T_table_sensor.push_back(frames.T_table_sensor[i]);
  }
  frames.positions = std::move(kept.positions);
  frames.T_table_sensor = std::move(kept.T_table_sensor);
}

}  // namespace turnscan::placement
