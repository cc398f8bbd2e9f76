#include <algorithm>
#include <array>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/bundle_system.hpp>

namespace turnscan::motion {

namespace {

using Eigen::Index;

constexpr double kHeldSigma_rad = 1e-7;
constexpr std::size_t kBlocks = 64;  // of frames, whose errors are compared

/// Errors that neighbouring pixels and frames share do not average out: the estimate of a shared
/// unknown by a block of frames then deviates more than independent noise explains. Returns the
/// excess as a factor of the variance.
double excess_variance(const std::vector<FrameEquations>& blocks, double scale_m) {
  double worst = 1.0;
  for (Index j = 0; j < 4; ++j) {
    std::vector<double> ratios;
    for (const FrameEquations& block : blocks) {
      const double expected = block.normal(j, j) * scale_m * scale_m;
      if (expected > 0.0) ratios.push_back(block.residual[j] * block.residual[j] / expected);
    }
    if (ratios.size() >= 8) worst = std::max(worst, median(ratios) / estimation::kMedianOfSquare);
  }
  return worst;
}

}  // namespace

std::pair<Index, double> AngleKnots::between(std::size_t frame) const {
  const auto next = std::upper_bound(frames_.begin(), frames_.end(), frame);
  const Index a = std::clamp<Index>(Index(next - frames_.begin()) - 1, 0, size() - 2);
  const auto low = double(frames_[std::size_t(a)]), high = double(frames_[std::size_t(a) + 1]);
  return {a, std::clamp((double(frame) - low) / (high - low), 0.0, 1.0)};
}

void BundleSystem::accumulate(const BundleState& at, const std::vector<std::size_t>& frames,
                              const SurfelObservations& observations) {
  const Index size = knots_.size() + 4, surfels = Index(at.surfels.size());
  matrix_ = Eigen::MatrixXd::Zero(size, size);
  right_ = Eigen::VectorXd::Zero(size);
  rows_ = Eigen::MatrixXf::Zero(surfels, size);
  total_ = sums_ = Eigen::VectorXd::Zero(surfels);
  residuals_ = 0;
  double squares = 0.0;
  std::vector<FrameEquations> blocks(kBlocks);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    FrameEquations sum;
    squares += add_frame(at, frames[k], observations.per_frame()[k], observations, sum);
    FrameEquations& block = blocks[k * kBlocks / frames.size()];
    block.normal += sum.normal, block.residual += sum.residual;
  }
  rms_m_ = std::sqrt(squares / double(std::max<std::size_t>(1, residuals_)));
  const double scale = observations.scale_m();
  variance_ = scale * scale * excess_variance(blocks, scale);
  eliminate_heights();
}

/// Returns the sum of its weighted squares.
double BundleSystem::add_frame(const BundleState& at, std::size_t frame,
                               const std::vector<SurfelObservation>& observed,
                               const SurfelObservations& observations, FrameEquations& sum) {
  const MotionState& state = at.motion;
  const Index n = knots_.size();
  const auto [u, v] = tangent_basis(state.axis);
  const auto [knot, share] = knots_.between(frame);
  const Eigen::Matrix3d R = Eigen::AngleAxisd(state.angle[frame], state.axis).toRotationMatrix();
  const Eigen::Matrix3d shift = Eigen::Matrix3d::Identity() - R;
  const Vec3d shift_u = shift * u, shift_v = shift * v;
  double squares = 0.0;
  for (const SurfelObservation& o : observed) {
    if (o.weight == 0.0f) continue;
    const Surfel& surfel = at.surfels[o.surfel];
    const Vec3d d = surfel.p - state.center, turned = R * d, m = R * surfel.n;
    const Vec3d tilt = turned.cross(m) - d.cross(surfel.n);
    Eigen::Matrix<double, 5, 1> row;
    row << tilt.dot(u), tilt.dot(v), m.dot(shift_u), m.dot(shift_v),
        m.dot(state.axis.cross(turned));
    const double w = o.weight, residual = observations.residual(o);
    sum.add(row, double(o.distance_m), w);
    sum.residual += w * residual * row;
    squares += w * residual * residual;
    const auto s = Index(o.surfel);
    rows_(s, knot) += float(w * (1.0 - share) * row[4]);
    rows_(s, knot + 1) += float(w * share * row[4]);
    for (Index j = 0; j < 4; ++j) rows_(s, n + j) += float(w * row[j]);
    total_[s] += w;
    sums_[s] += w * double(o.distance_m);
    ++residuals_;
  }
  add_block(sum, knot, share);
  return squares;
}

/// Fills the lower half of the matrix.
void BundleSystem::add_block(const FrameEquations& sum, Index knot, double share) {
  const std::array<double, 2> part{1.0 - share, share};
  for (Index a = 0; a < 2; ++a) {
    const double pa = part[std::size_t(a)];
    for (Index b = 0; b <= a; ++b)
      matrix_(knot + a, knot + b) += pa * part[std::size_t(b)] * sum.normal(4, 4);
    matrix_.block<4, 1>(knots_.size(), knot + a) += pa * sum.normal.topRightCorner<4, 1>();
    right_[knot + a] += pa * sum.right[4];
  }
  matrix_.bottomRightCorner<4, 4>() += sum.normal.topLeftCorner<4, 4>();
  right_.tail<4>() += sum.right.head<4>();
}

/// Schur complement, in blocks of columns.
void BundleSystem::eliminate_heights() {
  Eigen::VectorXf inverse = Eigen::VectorXf::Zero(total_.size());
  for (Index s = 0; s < total_.size(); ++s)
    if (total_[s] > 0.0) inverse[s] = float(1.0 / total_[s]);
  right_ -= (rows_.transpose() * sums_.cast<float>().cwiseProduct(inverse)).cast<double>();
  const Eigen::MatrixXf scaled = inverse.cwiseSqrt().asDiagonal() * rows_;
  constexpr Index kWidth = 48;
  const Index size = knots_.size() + 4, count = (size + kWidth - 1) / kWidth;
  parallel_for(std::size_t(count * count), 1, [&](std::size_t t) {
    const Index a = Index(t) / count, b = Index(t) % count;
    if (b > a) return;
    const Index na = std::min(kWidth, size - a * kWidth), nb = std::min(kWidth, size - b * kWidth);
    matrix_.block(a * kWidth, b * kWidth, na, nb) -=
        (scaled.middleCols(a * kWidth, na).transpose() * scaled.middleCols(b * kWidth, nb))
            .cast<double>();
  });
}

/// The observations with the prior and the platter.
BundleSystem::Dense BundleSystem::with_prior(const BundleState& at, const AnglePrior& prior) const {
  Dense out{matrix_, right_};
  const AddPriorRow add = [&](std::span<const PriorTerm> terms, double error, double worth) {
    for (const auto& [i, a] : terms) {
      out.right[i] -= variance_ * worth * a * error;
      for (const auto& [k, b] : terms)
        if (i >= k) out.matrix(i, k) += variance_ * worth * a * b;
    }
  };
  add_angle_prior(data_, knots_.frames(), at.knot_angle, prior, add);
  add_axis_prior(axis_prior(data_, view_shift_m_), at.motion.axis, at.motion.center, variance_,
                 out.matrix.bottomRightCorner<4, 4>(), out.right.tail<4>());
  return out;
}

double BundleSystem::minus_2_log_evidence(const BundleState& at, const AnglePrior& prior) const {
  const Dense system = with_prior(at, prior);
  const estimation::DenseLdlt factors(system.matrix);
  const Eigen::VectorXd step = factors.solve(system.right);
  std::vector<double> angle = at.knot_angle;
  for (std::size_t k = 0; k < angle.size(); ++k) angle[k] += step[Index(k)];
  const Eigen::VectorXd pulled = matrix_.selfadjointView<Eigen::Lower>() * step;
  const double lost = step.dot(pulled) - 2.0 * right_.dot(step);
  const AddPriorRow none = [](std::span<const PriorTerm>, double, double) {};
  return lost / variance_ + add_angle_prior(data_, knots_.frames(), angle, prior, none) +
         (factors.diagonal().array() / variance_).log().sum();
}

Result<> BundleSystem::solve(const BundleState& at, const AnglePrior& prior, bool hold_angles) {
  Dense system = with_prior(at, prior);
  for (Index k = 0; k < knots_.size() && hold_angles; ++k) {
    system.matrix(k, k) += variance_ / (kHeldSigma_rad * kHeldSigma_rad);
    system.right[k] = 0.0;
  }
  factors_.compute(system.matrix);
  step_ = factors_.solve(system.right);
  if (!factors_.succeeded() || !step_.allFinite())
    return fail(ErrorCode::kLibrary, "motion: the system of equations cannot be solved");
  return {};
}

std::vector<std::optional<double>> BundleSystem::heights() const {
  const Eigen::VectorXd turned = rows_.cast<double>() * step_;
  std::vector<std::optional<double>> out(std::size_t(total_.size()));
  for (Index s = 0; s < total_.size(); ++s)
    if (total_[s] > 0.0) out[std::size_t(s)] = (sums_[s] - turned[s]) / total_[s];
  return out;
}

Eigen::MatrixXd BundleSystem::inverse() const { return factors_.inverse(); }

}  // namespace turnscan::motion
