#pragma once
// Improves the triangle shapes of a marched surface.

#include <optional>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct ClusterScale {
  Vec3d origin_m = Vec3d::Zero();  ///< a sample of the grid that the surface was marched on
  double cell_m = 0.001;           ///< > 0
  /// Vertices exactly at this height (y) stay at it: the flat base.
  std::optional<float> flat_m;
};

/// Marching gives each edge of its grid a vertex, hence slivers between vertices around the same
/// sample. Merges these vertices into one at their mean; about a quarter of the triangles remain,
/// with edges about as long as a cell (regularised marching tetrahedra: Treece, Prager and Gee
/// 1999). Vertices are merged edge by edge, only if the surface stays a closed 2-manifold (the link
/// condition: the two have no common neighbours but the two beside their edge) and no triangle
/// rotates by more than about 60 degrees. The mesh must be closed and 2-manifold; attributes other
/// than positions are dropped. Works in place on the mesh passed in. Fails with kFormat as
/// validate_mesh does, kCancelled. Deterministic.
Result<TriangleMesh> merge_clustered_vertices(TriangleMesh mesh, const ClusterScale& scale,
                                              const RunContext& context);

}  // namespace turnscan
