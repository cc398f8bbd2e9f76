#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/linear_solvers.hpp>
#include <turnscan/turntable/placement/pair_constraints.hpp>

namespace turnscan::placement {

namespace {

constexpr double kFarthestSuccessor = kTurn / 6.0;
constexpr double kSameView = 14.0 * kRadiansPerDegree;
constexpr std::size_t kClosingPerFrame = 3;

motion::PairMotion motion_between(const std::vector<Pose>& poses, const FramePair& pair) {
  const Pose T = poses[pair.to].inverse() * poses[pair.from];
  return {T.linear(), Vec3d::Zero(), T.translation()};
}

/// Limits relative to the mean square of the points' motion along their normals: multiple of the
/// effect of the normals' noise on a direction, and minimum.
constexpr double kNoiseShare = 0.3, kMinShare = 0.02;

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
                         const FramePair& pair, const PairWeighting& weighting) {
  PairConstraint out;
  out.pair = pair;
  const motion::MotionFrame& from = frames.data.frames[pair.from];
  const motion::PairMotion relative = motion_between(poses, pair);
  const Pose& T_table = poses[pair.from];
  for (std::size_t s = pair.to % weighting.stride; s < from.samples.size(); s += weighting.stride) {
    const auto match =
        motion::match_sample(frames.data, from.samples[s], frames.data.frames[pair.to].surface,
                             relative, weighting.reach_m);
    if (!match) continue;
    const double weight = out.add_residual(match->residual, weighting.huber_m);
    if (!(weight > 0.0)) continue;
    const Vec3d n_table = T_table.linear() * match->n;
    Twist row;
    row.head<3>() = (T_table * match->p - frames.middle).cross(n_table) / frames.lever_m;
    row.tail<3>() = n_table;
    out.add(match->gain * row, -match->residual, weight);
    out.normal_noise +=
        weight * match->gain * match->gain * std::pow(double(from.samples[s].normal_sigma), 2);
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
  const double limit = std::max(kMinShare * all, kNoiseShare * noise);
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
  const motion::PairMotion relative = motion_between(poses, pair);
  const auto& samples = frames.data.frames[pair.from].samples;
  const double gate = std::max(3.0 * frames.data.noise_m, 0.002);
  motion::TruncatedCost cost;
  for (std::size_t s = 0; s < samples.size(); s += 3)
    cost.add(frames.data, samples[s], frames.data.frames[pair.to].surface, relative, gate);
  return cost.count > 0.0 ? cost.sum / cost.count : 1.0;
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
