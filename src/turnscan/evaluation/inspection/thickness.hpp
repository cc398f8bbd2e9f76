#pragma once
// Thickness of the walls of a mesh.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Thickness of the material behind each vertex, along its inward normal, as wall_thickness():
/// metres; NaN where the mesh is open there. Begins the phase "thickness". Fails with kFormat as
/// validate_mesh(), kTooFewPoints (no triangle), kCancelled.
Result<std::vector<float>> wall_thicknesses(const TriangleMesh& mesh, const RunContext& context);

/// The mesh with each vertex coloured by its thickness as by color_by_error(), but thin walls
/// yellow: 0 is yellow, thickest_m and more dark violet; mid grey where it is NaN.
TriangleMesh color_by_thickness(TriangleMesh mesh, const std::vector<float>& thickness_m,
                                double thickest_m);

}  // namespace turnscan
