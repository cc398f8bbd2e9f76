#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/motion/surfels.hpp>

namespace turnscan::motion {

namespace {

constexpr double kMinCosine = 0.5;                     // of incidence
constexpr double kMinWeight = 3.0;                     // in samples seen head-on
constexpr double kMinNormalAgreement = 0.8;            // length of the mean of unit normals
constexpr double kLowCosine = 0.3, kFullCosine = 0.5;  // of incidence: weight 0 to full between
constexpr double kMinRamp = 0.02;
constexpr std::size_t kMinObservations = 1000;

/// Weight by the cosine of incidence. Surface at oblique incidence is most informative about the
/// axis: seen head-on, a tilt of the axis towards the sensor looks like a cone. Noise is along the
/// ray, so the distance along the normal is scaled by the cosine; for a sensor with a spatial
/// filter it counts in full, since the filter causes errors there.
double incidence_weight(double cosine, bool filtered) {
  const double ramp = (cosine - kLowCosine) / (kFullCosine - kLowCosine);
  return std::clamp(ramp, kMinRamp, 1.0) / (filtered ? 1.0 : cosine * cosine);
}

struct TurnedSample {
  Vec3d p, n;
  double weight;
};

std::vector<TurnedSample> turned_samples(const MotionData& data, const MotionState& state) {
  std::vector<TurnedSample> out;
  for (const std::size_t f : data.keys) {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(-state.angle[f], state.axis).toRotationMatrix();
    for (const SurfaceSample& s : data.frames[f].samples) {
      const double cosine = -double(s.n.dot(s.p)) / double(s.p.norm());
      if (cosine < kMinCosine) continue;
      out.push_back(
          {R * (s.p.cast<double>() - state.center), R * s.n.cast<double>(), cosine * cosine});
    }
  }
  return out;
}

/// 20 bits per coordinate, and the dominant direction of the normal.
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

std::vector<Surfel> cell_means(const std::vector<TurnedSample>& samples, const Vec3d& center,
                               double size) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i)
    order.emplace_back(cell_of(samples[i], size), std::uint32_t(i));
  std::sort(order.begin(), order.end());
  std::vector<Surfel> out;
  for (std::size_t a = 0, b = 0; a < order.size(); a = b) {
    Vec3d p = Vec3d::Zero(), n = Vec3d::Zero();
    double weight = 0.0;
    for (; b < order.size() && order[b].first == order[a].first; ++b) {
      const TurnedSample& s = samples[order[b].second];
      p += s.weight * s.p, n += s.weight * s.n, weight += s.weight;
    }
    if (weight < kMinWeight || n.norm() < kMinNormalAgreement * weight) continue;
    out.push_back({center + p / weight, n.normalized()});
  }
  return out;
}

}  // namespace

std::vector<Surfel> make_surfels(const MotionData& data, const MotionState& state,
                                 std::size_t max_surfels) {
  const auto samples = turned_samples(data, state);
  // The number of cells that intersect a surface is about its area over theirs.
  double size = 0.1 * data.extent_m;
  auto out = cell_means(samples, state.center, size);
  for (int round = 0; round < 3 && !out.empty(); ++round) {
    const double finer = size * std::sqrt(double(out.size()) / double(max_surfels));
    if (finer > 0.97 * size) break;
    auto next = cell_means(samples, state.center, finer);
    if (next.size() <= out.size()) break;  // too few samples for more
    out = std::move(next), size = finer;
  }
  return out;
}

void SurfelObservations::observe(const MotionData& data, const MotionState& state,
                                 const std::vector<std::size_t>& frames,
                                 const std::vector<Surfel>& surfels, double reach_m,
                                 bool inner_only) {
  height_.assign(surfels.size(), 0.0);
  observed_.assign(frames.size(), {});
  parallel_for(frames.size(), 4, [&](std::size_t k) {
    const FrameSurface& surface = data.frames[frames[k]].raw_surface;
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(state.angle[frames[k]], state.axis).toRotationMatrix();
    for (std::size_t s = 0; s < surfels.size(); ++s) {
      const Vec3d q = state.center + R * (surfels[s].p - state.center);
      const Vec3d m = R * surfels[s].n;
      const double cosine = -m.dot(q) / q.norm();
      Vec3d found;
      if (cosine < kLowCosine || !data.find_correspondence(surface, q, reach_m, found)) continue;
      if (inner_only && !data.within_outline(surface, q)) continue;
      observed_[k].push_back({std::uint32_t(s), float(m.dot(found - q)),
                              float(incidence_weight(cosine, data.correlated_noise)), 0.0f});
    }
  });
}

bool SurfelObservations::weigh() {
  std::fill(height_.begin(), height_.end(), 0.0);
  for (int round = 0; round < 3; ++round) {
    std::vector<float> sizes;
    for (const auto& observed : observed_)
      for (std::size_t i = 0; i < observed.size(); i += 4)
        sizes.push_back(std::abs(residual(observed[i])));
    if (sizes.size() < kMinObservations / 4) return false;
    scale_m_ = std::max(estimation::mad_sigma(sizes), 1e-7);
    std::vector<double> sum(height_.size(), 0.0), total(height_.size(), 0.0);
    for (auto& observed : observed_) {
      for (SurfelObservation& o : observed) {
        const double size = std::abs(residual(o)), limit = kHuber * scale_m_;
        const double huber = size > 4.0 * limit ? 0.0 : estimation::huber_weight(size, limit);
        o.weight = float(huber * o.incidence);
        sum[o.surfel] += double(o.weight) * double(o.distance_m), total[o.surfel] += o.weight;
      }
    }
    for (std::size_t s = 0; s < height_.size(); ++s)
      height_[s] = total[s] > 0.0 ? sum[s] / total[s] : 0.0;
  }
  return true;
}

}  // namespace turnscan::motion
