#pragma once
// Normal equations of the bundle adjustment for axis and knots' angles, with the surfels' heights
// eliminated.

#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/turntable/motion/angle_prior.hpp>
#include <turnscan/turntable/motion/surfels.hpp>

namespace turnscan::motion {

/// Frames between which angles are interpolated.
class AngleKnots {
 public:
  /// Positions of at least two frames, increasing.
  explicit AngleKnots(std::vector<std::size_t> frames) : frames_(std::move(frames)) {}

  Eigen::Index size() const { return Eigen::Index(frames_.size()); }
  const std::vector<std::size_t>& frames() const { return frames_; }
  /// The knot before a frame, and the frame's relative position between it and the next, 0 to 1.
  std::pair<Eigen::Index, double> between(std::size_t frame) const;

 private:
  std::vector<std::size_t> frames_;
};

/// The unknowns.
struct BundleState {
  MotionState motion;
  std::vector<double> knot_angle;
  std::vector<Surfel> surfels;
};

/// One frame's equations. Unknowns: two tilts and two shifts of the axis, the frame's angle.
struct FrameEquations : estimation::NormalEquations<5> {
  Vector residual = Vector::Zero();  ///< the sum of weighted residuals times their rows
};

class BundleSystem {
 public:
  /// view_shift_m: as in AxisPrior.
  BundleSystem(const MotionData& data, const AngleKnots& knots, double view_shift_m)
      : data_(data), knots_(knots), view_shift_m_(view_shift_m) {}

  /// Linearises the observations of these frames at a state.
  void accumulate(const BundleState& at, const std::vector<std::size_t>& frames,
                  const SurfelObservations& observations);

  /// -2 times the logarithm of the evidence for a prior, up to a constant: the misfit of data and
  /// prior at the best step, and how strongly prior and data constrain the angles.
  double minus_2_log_evidence(const BundleState& at, const AnglePrior& prior) const;

  /// Solves for the step with a prior; with hold_angles the angles are kept fixed. Fails with
  /// kLibrary if the system cannot be solved.
  Result<> solve(const BundleState& at, const AnglePrior& prior, bool hold_angles);

  /// After solve(): knots' angles, then two tilts and two shifts of the axis.
  const Eigen::VectorXd& step() const { return step_; }
  /// After solve(): the step of each surfel along its normal, metres; nullopt if it was not seen.
  std::vector<std::optional<double>> heights() const;
  /// After solve(): the inverse of the matrix.
  Eigen::MatrixXd inverse() const;

  std::size_t residuals() const { return residuals_; }
  double rms_m() const { return rms_m_; }
  /// Variance of a residual, inflated for correlated errors.
  double variance_m2() const { return variance_; }

 private:
  struct Dense {
    Eigen::MatrixXd matrix;  ///< lower half
    Eigen::VectorXd right;
  };

  double add_frame(const BundleState& at, std::size_t frame,
                   const std::vector<SurfelObservation>& observed,
                   const SurfelObservations& observations, FrameEquations& sum);
  void add_block(const FrameEquations& sum, Eigen::Index knot, double share);
  void eliminate_heights();
  Dense with_prior(const BundleState& at, const AnglePrior& prior) const;

  const MotionData& data_;
  const AngleKnots& knots_;
  double view_shift_m_;
  std::size_t residuals_ = 0;
  double rms_m_ = 0.0, variance_ = 1.0;
  Eigen::MatrixXd matrix_;
  Eigen::VectorXd right_, step_;
  Eigen::VectorXd total_, sums_;  ///< per surfel: of the weights, and of the weighted distances
  Eigen::MatrixXf rows_;  ///< per surfel: weighted derivatives of its height by the unknowns
  estimation::DenseLdlt factors_;
};

}  // namespace turnscan::motion
