#pragma once
// Quick alignment of two thinned surfaces, from a rough start.

#include <span>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

/// One step a reach: pairs, in both directions, farther apart than that do not count, and their
/// weight falls with the distance to the tangent plane as Tukey's. Directions that the pairs do
/// not hold stay as they are. color_spread: so far apart colours are simply different, and their
/// gradients pull, too (Park, Zhou and Koltun 2017); 0: colours do not matter.
Pose align_levels(const SurfaceLevel& a, const SurfaceLevel& b, Pose T_a_b,
                  std::span<const double> reaches_m, float color_spread = 0.0f);

}  // namespace turnscan::passes
