#pragma once
// Where a closed mesh passes through itself.

#include <cstdint>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Per triangle, 1 where a ray along y through it is inside twice or less than not at all (a
/// winding number other than 0 and 1) just before or after it. The rays form a grid of that
/// spacing: where a closed mesh with outward triangles passes through itself by more than the
/// spacing in x and z, some triangle is marked; of a mesh that does not, none.
std::vector<std::uint8_t> winding_faults(const TriangleMesh& mesh, double spacing_m);

}  // namespace turnscan
