#pragma once
// Fast alignment of two thinned surfaces from an approximate start.

#include <span>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

/// Takes one step per reach: pairs farther apart are ignored, in both directions, and their weight
/// falls with the distance to the tangent plane (Tukey). Directions that the pairs do not constrain
/// are unchanged. color_spread: difference at which colours are simply different; then colour
/// gradients are used, too (Park, Zhou and Koltun 2017); 0: colours are ignored. Each stride-th
/// point is paired.
Pose align_levels(const SurfaceLevel& a, const SurfaceLevel& b, Pose T_a_b,
                  std::span<const double> reaches_m, float color_spread = 0.0f,
                  std::size_t stride = 1);

}  // namespace turnscan::passes
