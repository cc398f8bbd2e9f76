#pragma once
// Normals by which light on the surface is reckoned.

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::texture {

/// Per vertex, unit: the mean over a Gaussian of about a millimetre along the surface. A mesh of a
/// depth camera's frames errs finer than that by more than its shape bends. Where edges are longer,
/// vertex_normals() (mesh_repair.hpp) as they are.
std::vector<Vec3f> smoothed_normals(const TriangleMesh& mesh);

}  // namespace turnscan::texture
