#pragma once
// Rigid registration from a few corresponding points.

#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// The same point in two frames.
struct PointPair {
  Vec3d source = Vec3d::Zero(), target = Vec3d::Zero();
};

struct PairLimits {
  /// Minimum distance (rms) of the points from the straight line that fits them best, which
  /// determines the rotation about that line.
  double min_spread_m = 0.0;
  double max_residual_m = 0.0;  ///< maximum for any pair
};

struct PairFit {
  Pose T_target_source = Pose::Identity();
  std::vector<double> residuals_m;  ///< of each pair, after the motion
  double rms_m = 0.0;               ///< of them
};

/// The rigid motion, without scale, that minimises the squared distances between the moved source
/// points and the target points (Horn 1987; Umeyama 1991, equations 40 to 42, with c = 1). Never a
/// reflection. Fails with kTooFewPoints for fewer than three pairs and for points of either frame
/// that are too close to each other or to one straight line, with kInvalidOption if a point is not
/// finite or a pair contradicts the others; the messages count pairs from 1.
Result<PairFit> fit_point_pairs(std::span<const PointPair> pairs, const PairLimits& limits);

}  // namespace turnscan
