#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>

namespace turnscan::motion {

namespace {

constexpr double kObliquityFloor = 0.6;  // added to the squared cosines of both views
constexpr double kCut = 4.0;             // relative to Huber's limit
constexpr double kCostOfNone = 0.6;      // of a sample without a counterpart
constexpr double kContrastTurn = 8.0 * kRadiansPerDegree;

/// A sample, and the same in the frame of `to`.
struct Moved {
  Vec3d p, n, q, m;
};

Moved moved_by(const SurfaceSample& sample, const PairMotion& motion) {
  const Vec3d p = sample.p.cast<double>(), n = sample.n.cast<double>();
  const Vec3d turned = motion.R * (p - motion.center_from);
  return {p, n, motion.center_to + turned, motion.R * n};
}

/// Surface facing away from the sensor is not visible.
bool visible(const MotionData& data, const Moved& moved) {
  return !data.projective || !(-moved.m.dot(moved.q) < 0.25 * moved.q.norm());
}

PairMotion turn_about_axis(const MotionState& state, double turn_rad) {
  return {Eigen::AngleAxisd(turn_rad, state.axis).toRotationMatrix(), state.center, state.center};
}

/// Mean pair_cost with all pairs rotated apart by an angle.
double mean_cost_beside(const MotionData& data, const MotionState& state, double turn_rad) {
  const auto pairs = select_pairs(data, state.angle, false);
  const double gate = data.inlier_gate_m();
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < pairs.size(); k += 1 + pairs.size() / 400) {
    const double apart = state.angle[pairs[k].to] - state.angle[pairs[k].from];
    sum += pair_cost(data, state, pairs[k], apart + turn_rad, gate, 200);
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 1.0;
}

}  // namespace

std::array<double, 2> rotation_bias_terms(const MotionState& state, const FramePair& pair) {
  const double apart = std::remainder(state.angle[pair.to] - state.angle[pair.from], kTurn);
  return {apart, apart * std::abs(apart)};
}

std::optional<PairMatch> match_sample(const MotionData& data, const SurfaceSample& sample,
                                      const FrameSurface& surface, const PairMotion& motion,
                                      double reach_m) {
  const Moved moved = moved_by(sample, motion);
  const auto& [p, n, q, m] = moved;
  Vec3d found;
  if (!visible(data, moved) || !data.find_correspondence(surface, q, reach_m, found))
    return std::nullopt;
  // The effect of noise along both rays; a floor for other errors at grazing incidence.
  const double gain =
      data.projective ? 1.0 / std::sqrt(std::pow(n.dot(sample.p.cast<double>()), 2) /
                                            double(sample.p.squaredNorm()) +
                                        std::pow(m.dot(q), 2) / q.squaredNorm() + kObliquityFloor)
                      : 1.0;
  return PairMatch{p, n, q, m, gain, gain * m.dot(q - found)};
}

double PairSums::add_residual(double residual, double huber_m) {
  const double size = std::abs(residual);
  if (size > kCut * huber_m) {
    cost += estimation::huber_cost(kCut, 1.0) * huber_m * huber_m;
    return 0.0;
  }
  const double weight = estimation::huber_weight(size, huber_m);
  cost += estimation::huber_cost(size, huber_m);
  squares += weight * residual * residual;
  if (count % 8 == 0) sizes.push_back(float(size));
  ++count;
  return weight;
}

void TruncatedCost::add(const MotionData& data, const SurfaceSample& sample,
                        const FrameSurface& surface, const PairMotion& motion, double gate_m) {
  const Moved moved = moved_by(sample, motion);
  if (!visible(data, moved)) return;
  Vec3d found;
  count += 1.0;
  sum += data.find_correspondence(surface, moved.q, 4.0 * gate_m, found)
             ? std::min(1.0, std::pow(moved.m.dot(moved.q - found) / gate_m, 2))
             : kCostOfNone;
}

PairEquations linearise_pair(const MotionData& data, const MotionState& state,
                             const FramePair& pair, const PairWeighting& weighting) {
  PairEquations out;
  const MotionFrame& from = data.frames[pair.from];
  const auto bias = rotation_bias_terms(state, pair);
  const double turn = state.angle[pair.to] - state.angle[pair.from] +
                      state.rotation_bias[0] * bias[0] + state.rotation_bias[1] * bias[1];
  const PairMotion motion = turn_about_axis(state, turn);
  const auto [u, v] = tangent_basis(state.axis);
  const Eigen::Matrix3d shift = Eigen::Matrix3d::Identity() - motion.R;
  const Vec3d shift_u = shift * u, shift_v = shift * v;
  for (std::size_t s = pair.to % weighting.stride; s < from.samples.size(); s += weighting.stride) {
    const auto match = match_sample(data, from.samples[s], data.frames[pair.to].surface, motion,
                                    weighting.reach_m);
    if (!match) continue;
    const double weight = out.add_residual(match->residual, weighting.huber_m);
    if (!(weight > 0.0)) continue;
    const Vec3d& m = match->m;
    const Vec3d d = match->p - state.center, turned = motion.R * d;
    const Vec3d sweep = state.axis.cross(turned);
    const Vec3d tilt = turned.cross(m) - d.cross(match->n);
    Eigen::Matrix<double, 5, 1> row;
    row << tilt.dot(u), tilt.dot(v), m.dot(shift_u), m.dot(shift_v), m.dot(sweep);
    out.add(match->gain * row, -match->residual, weight);
  }
  return out;
}

double pair_cost(const MotionData& data, const MotionState& state, const FramePair& pair,
                 double angle_rad, double gate_m, std::size_t max_samples) {
  const std::vector<SurfaceSample>& samples = data.frames[pair.from].samples;
  const PairMotion motion = turn_about_axis(state, angle_rad);
  const std::size_t n = std::min(max_samples, samples.size());
  TruncatedCost cost;
  for (std::size_t k = 0; k < n; ++k)
    cost.add(data, samples[k * samples.size() / n], data.frames[pair.to].surface, motion, gate_m);
  // A rotation that leaves hardly any samples visible is not supported.
  if (cost.count < 0.2 * double(n) || cost.count == 0.0) return 1.0;
  return cost.sum / cost.count;
}

double mean_pair_cost(const MotionData& data, const MotionState& state) {
  return mean_cost_beside(data, state, 0.0);
}

double turn_contrast(const MotionData& data, const MotionState& state) {
  const double beside = 0.5 * (mean_cost_beside(data, state, kContrastTurn) +
                               mean_cost_beside(data, state, -kContrastTurn));
  return beside - mean_cost_beside(data, state, 0.0);
}

}  // namespace turnscan::motion
