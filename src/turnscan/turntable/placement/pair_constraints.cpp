#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/placement/pair_constraints.hpp>

namespace turnscan::placement {

namespace {

constexpr double kObliquityFloor = 0.6;  // added to the squared cosines of both views
constexpr double kFarthestSuccessor = kTurn / 6.0;
constexpr double kSameView = 14.0 * kRadiansPerDegree;
constexpr std::size_t kClosingPerFrame = 3;

/// What noise along both rays makes of a distance; a little for what else is wrong at low angles.
double gain_of(const motion::SurfaceSample& sample, const Vec3d& n, const Vec3d& m,
               const Vec3d& q) {
  const Vec3d p = sample.p.cast<double>();
  return 1.0 / std::sqrt(std::pow(n.dot(p), 2) / p.squaredNorm() +
                         std::pow(m.dot(q), 2) / q.squaredNorm() + kObliquityFloor);
}

/// Of the mean square of the points' ways along their normals: what the normals' noise alone shows
/// of a direction, as a multiple, and at least.
constexpr double kNoiseShare = 0.3, kLeastShare = 0.02;

void add_both(std::vector<FramePair>& pairs, const Keyframes& frames, std::size_t a,
              std::size_t b) {
  const auto add = [&](std::size_t from, std::size_t to) {
    if (!frames.data.frames[from].samples.empty() && !frames.data.frames[to].surface.empty())
      pairs.push_back({std::uint32_t(from), std::uint32_t(to)});
  };
  add(a, b);
  add(b, a);
}

}  // namespace

PairConstraint constrain(const Keyframes& frames, const std::vector<Pose>& poses,
                         const FramePair& pair, const ConstraintWeighting& weighting) {
  PairConstraint out;
  out.pair = pair;
  const motion::MotionFrame& from = frames.data.frames[pair.from];
  const motion::FrameSurface& surface = frames.data.frames[pair.to].surface;
  const Pose& T_table = poses[pair.from];
  const Pose T = poses[pair.to].inverse() * T_table;
  const double limit = weighting.huber_m;
  for (std::size_t s = pair.to % weighting.stride; s < from.samples.size(); s += weighting.stride) {
    const motion::SurfaceSample& sample = from.samples[s];
    const Vec3d n = sample.n.cast<double>(), p = sample.p.cast<double>();
    const Vec3d q = T * p, m = T.linear() * n;
    // Turned away from the sensor it cannot be seen.
    if (frames.data.projective && -m.dot(q) < 0.25 * q.norm()) continue;
    Vec3d found;
    if (!frames.data.find_correspondence(surface, q, weighting.reach_m, found)) continue;
    const double gain = frames.data.projective ? gain_of(sample, n, m, q) : 1.0;
    const double r = gain * m.dot(q - found), size = std::abs(r);
    if (size > 4.0 * limit) {
      out.cost += 7.0 * limit * limit;
      continue;
    }
    out.cost += size > limit ? limit * (2.0 * size - limit) : size * size;
    const Vec3d n_table = T_table.linear() * n;
    Twist row;
    row.head<3>() = (T_table * p - frames.middle).cross(n_table) / frames.lever_m;
    row.tail<3>() = n_table;
    row *= gain;
    const double weight = size > limit ? limit / size : 1.0;
    out.normal.noalias() += weight * row * row.transpose();
    out.right.noalias() -= weight * r * row;
    out.normal_noise += weight * gain * gain * std::pow(double(sample.normal_sigma), 2);
    if (out.count % 8 == 0) out.sizes.push_back(float(size));
    ++out.count;
  }
  out.normal = frames.shown * out.normal * frames.shown;
  out.right = frames.shown * out.right;
  return out;
}

void find_shown(Keyframes& frames, const std::vector<PairConstraint>& constraints) {
  Matrix6d sum = Matrix6d::Zero();
  double noise = 0.0;
  for (const PairConstraint& c : constraints) sum += c.normal, noise += c.normal_noise;
  const auto eigen = estimation::symmetric_eigen(sum);
  const double all = sum.bottomRightCorner<3, 3>().trace();
  const double limit = std::max(kLeastShare * all, kNoiseShare * noise);
  Twist shown;
  for (int k = 0; k < 6; ++k) shown[k] = eigen.values[k] > limit ? 1.0 : 0.0;
  frames.shown = eigen.vectors * shown.asDiagonal() * eigen.vectors.transpose();
}

std::vector<FramePair> successive_pairs(const Keyframes& frames, const std::vector<Pose>& poses) {
  std::vector<FramePair> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (const std::size_t step : {1, 2, 4}) {
      const std::size_t k = i + step;
      if (k >= frames.size()) continue;
      if (step == 1 || std::abs(turn_between(poses[i], poses[k])) < kFarthestSuccessor)
        add_both(out, frames, i, k);
    }
  }
  return out;
}

std::vector<FramePair> closing_pairs(const Keyframes& frames, const std::vector<Pose>& poses) {
  std::vector<FramePair> out;
  const std::size_t apart = std::max<std::size_t>(5, frames.size() / 4);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> near;
    for (std::size_t k = i + apart; k < frames.size(); ++k) {
      const double off = std::abs(turn_between(poses[i], poses[k]));
      if (off < kSameView) near.emplace_back(off, k);
    }
    std::sort(near.begin(), near.end());
    if (near.size() > kClosingPerFrame) near.resize(kClosingPerFrame);
    for (const auto& [off, k] : near) add_both(out, frames, i, k);
  }
  return out;
}

std::vector<FramePair> all_pairs(const Keyframes& frames, const std::vector<Pose>& poses) {
  auto out = successive_pairs(frames, poses);
  const auto closing = closing_pairs(frames, poses);
  out.insert(out.end(), closing.begin(), closing.end());
  return out;
}

double pair_mismatch(const Keyframes& frames, const std::vector<Pose>& poses,
                     const FramePair& pair) {
  const Pose T = poses[pair.to].inverse() * poses[pair.from];
  const auto& samples = frames.data.frames[pair.from].samples;
  const motion::FrameSurface& surface = frames.data.frames[pair.to].surface;
  const double gate = std::max(3.0 * frames.data.noise_m, 0.002);
  double sum = 0.0, count = 0.0;
  for (std::size_t s = 0; s < samples.size(); s += 3) {
    const Vec3d q = T * samples[s].p.cast<double>(), m = T.linear() * samples[s].n.cast<double>();
    if (frames.data.projective && -m.dot(q) < 0.25 * q.norm()) continue;
    Vec3d found;
    count += 1.0;
    if (!frames.data.find_correspondence(surface, q, 4.0 * gate, found)) {
      sum += 0.6;
      continue;
    }
    sum += std::min(1.0, std::pow(m.dot(q - found) / gate, 2));
  }
  return count > 0.0 ? sum / count : 1.0;
}

double mismatch(const Keyframes& frames, const std::vector<Pose>& poses) {
  const auto pairs = all_pairs(frames, poses);
  std::vector<double> each(pairs.size());
  parallel_for(pairs.size(), 4,
               [&](std::size_t k) { each[k] = pair_mismatch(frames, poses, pairs[k]); });
  double sum = 0.0;
  for (const double value : each) sum += value;
  return pairs.empty() ? 1.0 : sum / double(pairs.size());
}

}  // namespace turnscan::placement
