#include <algorithm>
#include <cmath>
#include <turnscan/turntable/motion_places.hpp>

namespace turnscan::detail {

namespace {

constexpr double kLeastCosine = 0.5;  // of incidence
constexpr double kLeastWeight = 3.0;  // in samples seen head-on
constexpr double kAgree = 0.8;        // length of the mean of unit normals

struct TurnedSample {
  Vec3d p, n;
  double weight;
};

std::vector<TurnedSample> turned_samples(const MotionData& data, const MotionState& state) {
  std::vector<TurnedSample> out;
  for (const std::size_t f : data.keys) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(-state.angle[f], state.axis).toRotationMatrix();
    for (const MotionSample& s : data.frames[f].samples) {
      const double cosine = -double(s.n.dot(s.p)) / double(s.p.norm());
      if (cosine < kLeastCosine) continue;
      out.push_back(
          {R * (s.p.cast<double>() - state.center), R * s.n.cast<double>(), cosine * cosine});
    }
  }
  return out;
}

/// 20 bits a coordinate, and which way the normal points most.
std::uint64_t cell_of(const TurnedSample& s, double size) {
  int side = 0;
  s.n.cwiseAbs().maxCoeff(&side);
  std::uint64_t key = std::uint64_t(side) + (s.n[side] < 0.0 ? 3 : 0);
  for (int k = 0; k < 3; ++k) {
    const double at = std::clamp(std::floor(s.p[k] / size), -524288.0, 524287.0);
    key = (key << 20) | std::uint64_t(std::int64_t(at) + 524288);
  }
  return key;
}

std::vector<SurfacePlace> means(const std::vector<TurnedSample>& samples, const Vec3d& center,
                                double size) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    order.emplace_back(cell_of(samples[i], size), std::uint32_t(i));
  std::sort(order.begin(), order.end());
  std::vector<SurfacePlace> out;
  for (std::size_t a = 0, b = 0; a < order.size(); a = b) {
    Vec3d p = Vec3d::Zero(), n = Vec3d::Zero();
    double weight = 0.0;
    for (; b < order.size() && order[b].first == order[a].first; ++b) {
      const TurnedSample& s = samples[order[b].second];
      p += s.weight * s.p, n += s.weight * s.n, weight += s.weight;
    }
    if (weight < kLeastWeight || n.norm() < kAgree * weight) continue;
    out.push_back({center + p / weight, n.normalized()});
  }
  return out;
}

}  // namespace

std::vector<SurfacePlace> surface_places(const MotionData& data, const MotionState& state,
                                         std::size_t most) {
  const auto samples = turned_samples(data, state);
  // As many cells meet a surface as its area over theirs.
  double size = 0.1 * data.extent_m;
  auto out = means(samples, state.center, size);
  for (int round = 0; round < 3 && !out.empty(); ++round) {
    const double finer = size * std::sqrt(double(out.size()) / double(most));
    if (finer > 0.97 * size) break;
    auto next = means(samples, state.center, finer);
    if (next.size() <= out.size()) break;  // too few samples for more
    out = std::move(next), size = finer;
  }
  return out;
}

}  // namespace turnscan::detail
