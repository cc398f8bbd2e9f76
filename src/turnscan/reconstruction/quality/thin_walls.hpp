#pragma once
// Where a closed mesh is thinner than a given thickness.

#include <cstdint>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/pseudo_normals.hpp>
#include <vector>

namespace turnscan::quality {

/// Tells at each vertex whether the outside begins within some thickness behind it: the point that
/// far along the inward normal lies outside. The mesh (metres, closed, outward) must outlive it.
/// Queries may run from many threads.
class ThinWalls {
 public:
  explicit ThinWalls(const TriangleMesh& mesh);

  /// vertex: below the number of vertices. thickness_m: > 0. False where no surface is found.
  bool thinner_than(double thickness_m, std::size_t vertex) const;

 private:
  const TriangleMesh& mesh_;
  MeshDistance distance_;
  PseudoNormals side_;
  std::vector<Vec3f> normals_;  ///< of the vertices
};

}  // namespace turnscan::quality
