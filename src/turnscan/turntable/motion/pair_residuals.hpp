#pragma once
// Point-to-plane residuals between two frames when one is rotated onto the other.

#include <array>
#include <optional>
#include <turnscan/core/eigen.hpp>
#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// Derivatives of the rotation between two views by the terms of MotionState::rotation_bias.
std::array<double, 2> rotation_bias_terms(const MotionState& state, const FramePair& pair);

/// The motion of points of `from` into the frame of `to`, as a rotation between two centres.
struct PairMotion {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Vec3d center_from = Vec3d::Zero(), center_to = Vec3d::Zero();
};

struct PairWeighting {
  double reach_m;      ///< maximum distance of correspondences
  double huber_m;      ///< larger residuals are downweighted, and cut from four times this value on
  std::size_t stride;  ///< every stride-th sample is used
};

/// A sample of `from` that has a counterpart on the surface of `to`.
struct PairMatch {
  Vec3d p, n;       ///< frame of `from`
  Vec3d q, m;       ///< the same, moved into the frame of `to`
  double gain;      ///< equalises the noise of points seen at different incidence angles
  double residual;  ///< distance to the counterpart along m, times the gain
};

/// nullopt if the moved sample faces away from the sensor or has no counterpart within reach_m.
std::optional<PairMatch> match_sample(const MotionData& data, const SurfaceSample& sample,
                                      const FrameSurface& surface, const PairMotion& motion,
                                      double reach_m);

/// Robust sums over the residuals of a pair.
struct PairSums {
  double cost = 0.0;         ///< Huber's function, cut at four times its limit, m^2
  double squares = 0.0;      ///< weighted
  std::size_t count = 0;     ///< number of residuals with non-zero weight
  std::vector<float> sizes;  ///< of every eighth residual, metres

  /// Adds a residual and returns its weight; 0 if it is cut.
  double add_residual(double residual, double huber_m);
};

/// Normal equations of one pair. Unknowns: two tilts of the axis, two shifts of the centre, angle
/// of `to` minus angle of `from`.
struct PairEquations : estimation::NormalEquations<5>, PairSums {};

PairEquations linearise_pair(const MotionData& data, const MotionState& state,
                             const FramePair& pair, const PairWeighting& weighting);

/// Sum of the truncated squared distances of samples, in units of a gate squared.
struct TruncatedCost {
  double sum = 0.0, count = 0.0;

  /// A sample adds from 0 to 1, or 0.6 without a counterpart within four gates, and is ignored if
  /// it faces away from the sensor.
  void add(const MotionData& data, const SurfaceSample& sample, const FrameSurface& surface,
           const PairMotion& motion, double gate_m);
};

/// Mean truncated squared distance over the samples of the pair, in units of gate_m squared, with
/// the frames `angle_rad` apart; samples without a correspondence count 0.6.
double pair_cost(const MotionData& data, const MotionState& state, const FramePair& pair,
                 double angle_rad, double gate_m, std::size_t max_samples);

/// Increase of mean_pair_cost, averaged over both directions, when every pair is rotated apart by 8
/// degrees: how well the shape determines its rotation. Below 0.01 for a round object.
double turn_contrast(const MotionData& data, const MotionState& state);

/// Mean pair_cost of neighbouring frames with the axis and the angles of a state.
double mean_pair_cost(const MotionData& data, const MotionState& state);

}  // namespace turnscan::motion
