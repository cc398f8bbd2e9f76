#pragma once
// Global search for a motion: for each of a few thousand rotations, every pair of points whose
// normals then agree votes for the translation that brings it together (a generalised Hough
// transform).

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/samples.hpp>

namespace turnscan::passes {

/// Rotations such that every rotation is within about 0.75 * spacing_rad of one of them.
std::vector<Eigen::Matrix3f> rotation_grid(double spacing_rad);

struct VotedMotion {
  Pose T_a_b = Pose::Identity();
  float votes = 0.0f;
};

/// The `count` motions with the most votes, at most two per rotation, best first. extent_m: of the
/// larger of the two surfaces. color_spread: votes of points whose colours differ by this much have
/// little weight; 0: colours are ignored. Fails with kCancelled.
Result<std::vector<VotedMotion>> vote_motions(const Samples& a, const Samples& b, double extent_m,
                                              std::size_t count, float color_spread,
                                              const RunContext& context);

}  // namespace turnscan::passes
