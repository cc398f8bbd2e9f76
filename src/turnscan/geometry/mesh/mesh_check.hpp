#pragma once
// Topological and geometric properties of a mesh.

#include <cstddef>
#include <cstdint>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Counts and measures of a mesh. Triangles that reference a vertex that does not exist or is not
/// finite are counted in invalid_triangles and ignored elsewhere; triangles that repeat a vertex
/// are ignored in the edge and vertex counts, too.
struct MeshReport {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t invalid_triangles = 0;      ///< index out of range, or a vertex that is not finite
  std::size_t degenerate_triangles = 0;   ///< a repeated vertex, or an area of exactly zero
  std::size_t repeated_vertices = 0;      ///< of those, the triangles that repeat a vertex
  std::size_t unreferenced_vertices = 0;  ///< vertices that no valid triangle references
  std::size_t edges = 0;
  std::size_t boundary_edges = 0;         ///< edges of one triangle
  std::size_t non_manifold_edges = 0;     ///< edges of three or more triangles
  std::size_t misoriented_edges = 0;      ///< edges whose two triangles traverse them in the same
                                          ///< direction
  std::size_t crossing_edges = 0;         ///< edges that pass through other triangles,
                                          ///< which check_mesh() does not count
  std::size_t non_manifold_vertices = 0;  ///< vertices whose triangles form more than one fan
  int components = 0;                     ///< pieces that share no vertex
  long long euler = 0;  ///< referenced vertices - edges + triangles (2 for a sphere)
  double area_m2 = 0.0;
  double volume_m3 = 0.0;  ///< signed, positive when oriented outward; meaningful when closed
  bool closed = false;     ///< has triangles and no boundary edge
  bool manifold = false;   ///< no invalid, vertex-repeating or non-manifold element
  bool oriented = false;   ///< no two neighbours traverse their edge in the same direction
  /// Closed, manifold and oriented, and every piece has a positive volume, or a negative one inside
  /// a piece with a positive one (a cavity; at most 64 pieces with negative volume are examined).
  bool outward = false;

  /// Closed, 2-manifold, consistently outward, as printing requires.
  bool watertight() const { return closed && manifold && oriented && outward; }
  /// One line for display: "watertight, 1 piece, 1234 vertices, ..." or why it is not watertight.
  std::string text() const;
};

/// Never fails, whatever the mesh contains. O(triangles); about 0.3 s for a million triangles.
/// broken, if given, gets one flag per vertex: those of edges that have not just two triangles, and
/// those whose triangles form more than one fan.
MeshReport check_mesh(const TriangleMesh& mesh, std::vector<std::uint8_t>* broken = nullptr);
/// With crossing_edges (self_intersections()): about 2 s for a million triangles.
/// Once the context is cancelled the report is incomplete.
MeshReport check_surface(const TriangleMesh& mesh, const RunContext& context = RunContext());

}  // namespace turnscan
