#pragma once
// How well two frames fit each other when one is turned onto the other: point-to-plane distances.

#include <Eigen/Core>
#include <array>
#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// What the turn between two views changes by with each term of MotionState::rotation_bias.
std::array<double, 2> rotation_bias_terms(const MotionState& state, const FramePair& pair);

/// Normal equations of one pair. Unknowns: two tilts of the axis, two shifts of the centre, angle
/// of `to` minus angle of `from`.
struct PairEquations {
  Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Matrix<double, 5, 1> right = Eigen::Matrix<double, 5, 1>::Zero();
  double squares = 0.0, cost = 0.0;
  std::size_t count = 0;
  std::vector<float> sizes;  ///< of every eighth residual, metres
};

struct PairWeighting {
  double reach_m;      ///< correspondences farther away do not count
  double huber_m;      ///< larger residuals weigh less, from four times that on nothing
  std::size_t stride;  ///< every stride-th sample is used
};

PairEquations linearise_pair(const MotionData& data, const MotionState& state,
                             const FramePair& pair, const PairWeighting& weighting);

/// Mean truncated squared distance over the samples of the pair, as a multiple of gate_m squared,
/// with the frames' angles apart by `angle_rad`; samples without a correspondence count 0.6.
double pair_cost(const MotionData& data, const MotionState& state, const FramePair& pair,
                 double angle_rad, double gate_m, std::size_t max_samples);

/// By how much mean_pair_cost grows, in the mean of both directions, when every pair is turned
/// apart by 8 degrees: what the shape shows of its turn. Under a hundredth for a round object.
double turn_contrast(const MotionData& data, const MotionState& state);

/// Mean pair_cost of neighbouring frames with the axis and the angles of a state.
double mean_pair_cost(const MotionData& data, const MotionState& state);

}  // namespace turnscan::motion
