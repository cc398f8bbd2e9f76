#pragma once

#include <filesystem>
#include <turnscan/core/result.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

struct AssimpMeshes {
  std::vector<turnscan::TriangleMesh> meshes;  ///< one for each node that has triangles
  double metres_per_unit = 1.0;                ///< as the file says; 1 if it does not
};

/// Reads any format that assimp knows. Normals are left out: without them, vertices are shared
/// across edges, and a closed surface stays closed.
turnscan::Result<AssimpMeshes> read_with_assimp(const std::filesystem::path& path);
