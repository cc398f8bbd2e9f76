#pragma once
// Normals for shading computations.

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::texture {

/// Per vertex, unit: the mean over a Gaussian of about a millimetre along the surface. At finer
/// scales a mesh from depth frames has errors larger than the bending of its shape. If edges are
/// longer, vertex_normals() (mesh_repair.hpp) unchanged.
std::vector<Vec3f> smoothed_normals(const TriangleMesh& mesh);

}  // namespace turnscan::texture
