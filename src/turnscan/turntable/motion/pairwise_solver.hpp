#pragma once
// All frames in one least-squares problem over pairs of them: they share the axis, and each has one
// angle.

#include <turnscan/turntable/motion/angle_prior.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>

namespace turnscan::motion {

struct SolveOptions {
  int iterations = 8;
  double reach_m = 0.02;     ///< correspondences farther away do not count, at first
  double floor_m = 0.0;      ///< residuals up to this count in full until the end
  std::size_t stride = 1;    ///< use every stride-th sample
  bool hold_angles = false;  ///< leave the angles to the prior
  bool hold_axis = false;    ///< axis and centre stay as they are
  bool use_platter = true;   ///< for the axis, where one was seen
  bool covariance = false;
  std::optional<double> scale_m;      ///< of the residuals, where it is known
  std::optional<double> variance_m2;  ///< as in MotionSolution, where it is known
};

struct MotionSolution {
  MotionState state;
  double scale_m = 0.0;      ///< robust standard deviation of the residuals
  double variance_m2 = 0.0;  ///< of a residual, enlarged by what correlated errors add
  double rms_m = 0.0;
  std::size_t residuals = 0;
  /// -2 times the logarithm of the probability of the data, given the prior, up to a constant: what
  /// is lost by a prior too narrow against what is gained by having fewer free angles.
  double minus_2_log_evidence = 0.0;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  ///< axis (two tilts), centre (two shifts)
  std::vector<double> angle_sigma;
};

/// Point-to-plane distances (Chen and Medioni 1992) between frames, minimised over the axis, a
/// point of it and all angles by Gauss-Newton steps with Huber weights; the normal equations are
/// sparse. Fails with kTooFewPoints when fewer than 100 samples have a correspondence, kLibrary
/// when the system cannot be solved, kCancelled.
Result<MotionSolution> solve_pairwise(const MotionData& data, const MotionState& start,
                                      const std::vector<FramePair>& pairs, const AnglePrior& prior,
                                      const SolveOptions& options, const RunContext& context);

/// Every how manyth sample a coarse solution uses: few depth images have no samples to spare.
inline std::size_t coarse_stride(const MotionData& data, std::size_t wanted) {
  return data.keys.size() > 24 || !data.projective ? wanted : 1;
}

}  // namespace turnscan::motion
