#pragma once
// Finds where a closed mesh is thinner than a given thickness.

#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/pseudo_normals.hpp>

namespace turnscan::quality {

/// Tests at each vertex whether the outside begins within some thickness behind it: whether the
/// point at that distance along the inward normal is outside. The mesh (metres, closed, outward)
/// and the unit normals of its vertices must outlive it. Queries may run from many threads.
class ThinWalls {
 public:
  ThinWalls(const TriangleMesh& mesh, std::span<const Vec3f> normals);

  /// vertex: below the number of vertices. thickness_m: > 0. False if no surface is found.
  bool thinner_than(double thickness_m, std::size_t vertex) const;

 private:
  const TriangleMesh& mesh_;
  MeshDistance distance_;
  PseudoNormals side_;
  std::span<const Vec3f> normals_;
};

}  // namespace turnscan::quality
