#pragma once
// From roughly where somebody put a pass to where its surface lies on that of the others.

#include <span>
#include <turnscan/reconstruction/passes/join_passes.hpp>

namespace turnscan::passes {

/// A pass whose place is known; surface must outlive it.
struct PlacedSurface {
  const PassSurface* surface = nullptr;
  Pose T_here_pass = Pose::Identity();
};

struct RefinedMotion {
  Pose T_here_pass = Pose::Identity();
  std::string misfit;  ///< why the surfaces do not lie on each other there; empty: they do
  double sigma_m = 0.0, sigma_rad = 0.0, overlap_m2 = 0.0;  ///< as PassMotion's
};

/// Brings a pass that lies within about a twentieth of the object's size of the truth onto the
/// others. Of what shapes leave open, as the turn of a vase about its axis, that which moves its
/// surface least is taken.
/// Fails with kTooFewPoints where a surface has fewer than 200 points, and with kCancelled.
Result<RefinedMotion> refine_motion(std::span<const PlacedSurface> placed, const PassSurface& pass,
                                    const Pose& T_here_pass, const JoinOptions& options,
                                    const RunContext& context);

}  // namespace turnscan::passes
