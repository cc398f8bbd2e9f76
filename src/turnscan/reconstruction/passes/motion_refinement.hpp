#pragma once
// Refines the approximate, manually given motion of a pass by its surface and those of the others.

#include <span>
#include <turnscan/reconstruction/passes/join_passes.hpp>

namespace turnscan::passes {

/// A pass whose pose is known; surface must outlive it.
struct PlacedSurface {
  const PassSurface* surface = nullptr;
  Pose T_here_pass = Pose::Identity();
};

struct RefinedMotion {
  Pose T_here_pass = Pose::Identity();
  std::string misfit;  ///< why the surfaces do not match there; empty if they do
  double sigma_m = 0.0, sigma_rad = 0.0, overlap_m2 = 0.0;  ///< as in PassMotion
};

/// Aligns a pass with the others, starting within about a twentieth of the object's size of the
/// true motion. Of motions that shapes leave undetermined, such as the rotation of a vase about its
/// axis, takes the one that moves its surface least. Fails with kTooFewPoints if a surface has
/// fewer than 200 points, and with kCancelled.
Result<RefinedMotion> refine_motion(std::span<const PlacedSurface> placed, const PassSurface& pass,
                                    const Pose& T_here_pass, const JoinOptions& options,
                                    const RunContext& context);

}  // namespace turnscan::passes
