#pragma once
// Areas and volumes of meshes with valid triangle indices.

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// In square metres.
double triangle_area(const TriangleMesh& mesh, std::size_t triangle);
double surface_area(const TriangleMesh& mesh);

/// In cubic metres, positive if the triangles of a closed mesh face outward.
double signed_volume(const TriangleMesh& mesh);

}  // namespace turnscan
