#pragma once
// Steps that turn triangles into a surface. Every function checks its mesh first and fails with
// kFormat as validate_mesh does; an empty mesh is returned unchanged. Per-vertex colours and
// normals are preserved; vertices that a step creates get them from their neighbours. All are
// deterministic.

#include <cstdint>
#include <limits>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Merges vertices that agree in all three coordinates (STL soups), or, with a tolerance, those
/// that are connected by chains of distances within tolerance_m; position and attributes of the
/// first one are kept. Triangles that lose a corner thereby are dropped.
Result<TriangleMesh> merge_vertices(const TriangleMesh& mesh, double tolerance_m = 0.0);

/// Drops triangles that repeat a vertex, that have no area at all, or that are exact copies of an
/// earlier one (same three vertices, either way round); then unreferenced vertices.
Result<TriangleMesh> remove_degenerate(const TriangleMesh& mesh);

/// One mesh per piece (pieces share no vertex), most triangles first, then by first triangle.
Result<std::vector<TriangleMesh>> split_components(const TriangleMesh& mesh);

/// All triangles of all meshes in one; attributes are kept if every mesh with vertices has them.
TriangleMesh join_meshes(const std::vector<TriangleMesh>& meshes);

/// Makes every edge one of at most two triangles that traverse it in opposite directions, and every
/// vertex the centre of one fan, by cutting the surface apart where that fails (vertices are
/// duplicated, no triangle with area is dropped, none is moved). Where three or more triangles meet
/// at an edge, the two that continue each other most smoothly stay connected. Cuts leave
/// boundaries. The triangles' orientations are kept: neighbours that disagree are cut apart, so
/// call orient_consistently first if they are not reliable.
Result<TriangleMesh> make_manifold(const TriangleMesh& mesh);

/// Flips triangles so that neighbours across two-triangle edges agree, piece by piece, by flood
/// fill from the piece's first triangle (a one-sided piece keeps disagreements; make_manifold then
/// cuts it).
Result<TriangleMesh> orient_consistently(const TriangleMesh& mesh);

/// orient_consistently, then flips whole pieces whose signed volume is negative. For a piece that
/// is not closed the volume of the cone from its centroid decides, i.e. most of it faces away from
/// there.
Result<TriangleMesh> orient_outward(const TriangleMesh& mesh);

struct FillHolesOptions {
  /// Loops with more edges than this stay open.
  std::size_t max_edges = std::numeric_limits<std::size_t>::max();
  bool refine = true;    ///< split the new triangles down to the edge length around the hole
  bool fair = true;      ///< let the refined patch continue its surroundings smoothly
  double tension = 0.0;  ///< as RelaxOptions::tension
};

struct FilledMesh {
  TriangleMesh mesh;
  std::vector<std::uint8_t> filled;  ///< per triangle: 1 = it closes a hole
  std::size_t holes = 0;             ///< number of loops closed
};

/// Closes the boundary loops of a mesh that make_manifold would not change (kFormat otherwise).
/// Loops of up to some hundred edges get the triangulation of least area (Barequet and Sharir 1995,
/// by dynamic programming; larger loops are first halved greedily); the patch is refined (Liepa
/// 2003, after Pfeifle and Seidel 1996) and faired. The result is manifold and consistently
/// oriented and, without max_edges, closed. Patches may intersect other parts of the surface.
Result<FilledMesh> fill_holes(const TriangleMesh& mesh, const FillHolesOptions& options,
                              const RunContext& context);

struct RelaxOptions {
  /// 0: thin plate (continues slope and curvature of the surroundings), 1: membrane (least area,
  /// like a soap film); a mixture in between.
  double tension = 0.0;
};
OptionTable describe(RelaxOptions& options);

/// Moves the vertices with movable[v] != 0 (one entry a vertex) to where the patch they form
/// continues its fixed surroundings as a thin plate or membrane; connectivity stays. Weights are
/// uniform (every edge counts the same): unlike cotangents they cannot become negative or huge on
/// slivers and folds, which is what the balloons that this is used on are full of. Each connected
/// movable region is solved on its own, sparse Cholesky; regions without a fixed neighbour do not
/// move. Normals of moved vertices are recomputed. A region of 10,000 vertices takes 0.1 s,
/// one of 100,000 some 9 s, in which it cannot be cancelled.
/// Fails with kInvalidOption when movable does not fit, kLibrary when a system cannot be solved,
/// kResourceLimit for regions of over two million vertices, kCancelled.
Result<TriangleMesh> relax(const TriangleMesh& mesh, const std::vector<std::uint8_t>& movable,
                           const RelaxOptions& options, const RunContext& context);

/// The whole chain for arbitrary triangles: merge, remove_degenerate, orient_consistently,
/// make_manifold, fill_holes, orient_outward. The result passes check_mesh(...).watertight(), or
/// the call fails with kTooFewPoints (nothing is left) or kLibrary (with the reason).
Result<TriangleMesh> repair(const TriangleMesh& mesh, const FillHolesOptions& options,
                            const RunContext& context);

/// Unit normals per vertex, weighted by the angle of each triangle at the vertex; zero if there is
/// no triangle with area.
std::vector<Vec3f> vertex_normals(const TriangleMesh& mesh);

}  // namespace turnscan
