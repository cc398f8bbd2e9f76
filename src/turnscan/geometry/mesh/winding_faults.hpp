#pragma once
// Detects self-intersections of a closed mesh.

#include <cstdint>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Per triangle, 1 if a ray along y through it has a winding number other than 0 and 1 just before
/// or after it. The rays form a grid of that spacing: where a closed mesh with outward triangles
/// intersects itself by more than the spacing in x and z, some triangle is marked; without
/// self-intersections, none is.
std::vector<std::uint8_t> winding_faults(const TriangleMesh& mesh, double spacing_m);

}  // namespace turnscan
