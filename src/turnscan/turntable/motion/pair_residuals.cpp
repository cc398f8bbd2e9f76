#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>

namespace turnscan::motion {

namespace {

constexpr double kObliquityFloor = 0.6;  // added to the squared cosines of both views
constexpr double kContrastTurn = 8.0 * kRadiansPerDegree;

/// Mean pair_cost with all pairs turned apart by an angle.
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

PairEquations linearise_pair(const MotionData& data, const MotionState& state,
                             const FramePair& pair, const PairWeighting& weighting) {
  PairEquations out;
  const MotionFrame& from = data.frames[pair.from];
  const FrameSurface& surface = data.frames[pair.to].surface;
  const auto bias = rotation_bias_terms(state, pair);
  const double turn = state.angle[pair.to] - state.angle[pair.from] +
                      state.rotation_bias[0] * bias[0] + state.rotation_bias[1] * bias[1];
  const Eigen::Matrix3d R = Eigen::AngleAxisd(turn, state.axis).toRotationMatrix();
  const auto [u, v] = tangent_basis(state.axis);
  const Eigen::Matrix3d shift = Eigen::Matrix3d::Identity() - R;
  const Vec3d shift_u = shift * u, shift_v = shift * v;
  for (std::size_t s = pair.to % weighting.stride; s < from.samples.size(); s += weighting.stride) {
    const SurfaceSample& sample = from.samples[s];
    const Vec3d n = sample.n.cast<double>(), d = sample.p.cast<double>() - state.center;
    const Vec3d turned = R * d, m = R * n, q = state.center + turned;
    // Turned away from the sensor it cannot be seen.
    if (data.projective && -m.dot(q) < 0.25 * q.norm()) continue;
    Vec3d found;
    if (!data.find_correspondence(surface, q, weighting.reach_m, found)) continue;
    // What noise along both rays makes of it; a little for what else is wrong at low angles.
    const double gain =
        data.projective ? 1.0 / std::sqrt(std::pow(n.dot(sample.p.cast<double>()), 2) /
                                              double(sample.p.squaredNorm()) +
                                          std::pow(m.dot(q), 2) / q.squaredNorm() + kObliquityFloor)
                        : 1.0;
    const double r = gain * m.dot(q - found), size = std::abs(r);
    const double limit = weighting.huber_m;
    if (size > 4.0 * limit) {
      out.cost += 7.0 * limit * limit;
      continue;
    }
    out.cost += size > limit ? limit * (2.0 * size - limit) : size * size;
    const Vec3d sweep = state.axis.cross(turned);
    const Vec3d tilt = turned.cross(m) - d.cross(n);
    Eigen::Matrix<double, 5, 1> row;
    row << tilt.dot(u), tilt.dot(v), m.dot(shift_u), m.dot(shift_v), m.dot(sweep);
    row *= gain;
    const double weight = size > limit ? limit / size : 1.0;
    out.normal.noalias() += weight * row * row.transpose();
    out.right.noalias() -= weight * r * row;
    out.squares += weight * r * r;
    if (out.count % 8 == 0) out.sizes.push_back(float(size));
    ++out.count;
  }
  return out;
}

double pair_cost(const MotionData& data, const MotionState& state, const FramePair& pair,
                 double angle_rad, double gate_m, std::size_t max_samples) {
  const MotionFrame& from = data.frames[pair.from];
  const FrameSurface& surface = data.frames[pair.to].surface;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(angle_rad, state.axis).toRotationMatrix();
  const std::size_t n = std::min(max_samples, from.samples.size());
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const SurfaceSample& sample = from.samples[k * from.samples.size() / n];
    const Vec3d q = state.center + R * (sample.p.cast<double>() - state.center);
    const Vec3d m = R * sample.n.cast<double>();
    if (data.projective && -m.dot(q) < 0.25 * q.norm()) continue;
    Vec3d found;
    count += 1.0;
    if (!data.find_correspondence(surface, q, 4.0 * gate_m, found)) {
      sum += 0.6;
      continue;
    }
    sum += std::min(1.0, std::pow(m.dot(q - found) / gate_m, 2));
  }
  // A turn that shows next to nothing of the samples explains nothing.
  if (count < 0.2 * double(n) || count == 0.0) return 1.0;
  return sum / count;
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
