#pragma once
// One least-squares problem over pairs of all frames, which share the axis and have one angle each.

#include <turnscan/turntable/motion/angle_prior.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>

namespace turnscan::motion {

struct SolveOptions {
  int iterations = 8;
  double reach_m = 0.02;      ///< initial maximum distance of correspondences
  double floor_m = 0.0;       ///< residuals up to this have full weight until the end
  std::size_t stride = 1;     ///< use every stride-th sample
  bool hold_angles = false;   ///< leave the angles to the prior
  bool hold_axis = false;     ///< keep axis and centre fixed
  bool use_platter = true;    ///< as prior of the axis, if one was seen
  double view_shift_m = 0.0;  ///< as in AxisPrior
  bool covariance = false;
  std::optional<double> scale_m;      ///< of the residuals, if it is known
  std::optional<double> variance_m2;  ///< as in MotionSolution, if it is known
};

struct MotionSolution {
  MotionState state;
  double scale_m = 0.0;      ///< robust standard deviation of the residuals
  double variance_m2 = 0.0;  ///< of a residual, inflated for correlated errors
  double rms_m = 0.0;
  std::size_t residuals = 0;
  /// -2 times the logarithm of the probability of the data, given the prior, up to a constant:
  /// balances the misfit caused by a narrow prior against the gain of fewer free angles.
  double minus_2_log_evidence = 0.0;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< axis (two tilts), centre (two shifts)
  std::vector<double> angle_sigma;
};

/// Point-to-plane distances (Chen and Medioni 1992) between frames, minimised over the axis, a
/// point on it and all angles by Gauss-Newton steps with Huber weights; the normal equations are
/// sparse. Fails with kTooFewPoints if fewer than 100 samples have a correspondence, with kLibrary
/// if the system cannot be solved, with kCancelled.
Result<MotionSolution> solve_pairwise(const MotionData& data, const MotionState& start,
                                      const std::vector<FramePair>& pairs, const AnglePrior& prior,
                                      const SolveOptions& options, const RunContext& context);

/// Sampling stride of a coarse solution: with few depth images all samples are needed.
inline std::size_t coarse_stride(const MotionData& data, std::size_t wanted) {
  return data.keys.size() > 24 || !data.projective ? wanted : 1;
}

}  // namespace turnscan::motion
