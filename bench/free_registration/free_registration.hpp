#pragma once
// Pairwise registration with six degrees of freedom by PCL, the peer that calibration from motion
// is compared with.

#include <span>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan {

enum class FreeMethod {
  kIcp,  ///< point to point (Besl and McKay 1992)
  kGicp  ///< generalised ICP (Segal, Haehnel and Thrun 2009)
};

/// T_target_source that moves the source onto the target, from `start` on. Pairs farther apart than
/// max_distance_m are not used. Fails with kTooFewPoints for fewer than 20 points on either side,
/// kLibrary when PCL does not converge.
Result<Pose> pairwise_icp(std::span<const Vec3f> source, std::span<const Vec3f> target,
                          const Pose& start, FreeMethod method, double max_distance_m,
                          int iterations);

}  // namespace turnscan
