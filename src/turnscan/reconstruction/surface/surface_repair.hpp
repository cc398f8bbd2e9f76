#pragma once
// Repairs the result of a surface method to a printable mesh.

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan::surface {

struct RepairedMesh {
  TriangleMesh mesh;
  MeshReport check;
  std::vector<Evidence>
      evidence;  ///< per triangle: invented is what no candidate is within reach of
  double invented_area_m2 = 0.0;
  std::vector<std::string> notes;  ///< repairs, for display
};

/// Pieces of a surface that are kept: the one with the most vertices near candidates, or also
/// others that are mostly near candidates, for objects with separate parts.
enum class Parts { kMain, kAll };

/// Makes a Poisson surface closed, 2-manifold and outward: drops other pieces, and where no
/// candidate is within reach_m, replaces what Poisson invented (blobs, sheets) by a smooth and
/// tight continuation of its surroundings if it swells beyond them. Fails with kLibrary, with the
/// reason, if the result would not be watertight.
Result<RepairedMesh> repair_poisson(const TriangleMesh& raw, const PointCloud& candidates,
                                    double reach_m, Parts parts, const RunContext& context);

/// A closed, 2-manifold, outward surface around a concave hull: wrapped on cells of cell_m.
Result<RepairedMesh> repair_concave_hull(const TriangleMesh& raw, const PointCloud& candidates,
                                         double cell_m, double reach_m, Parts parts,
                                         const RunContext& context);

/// Marks triangles near candidates as base if the candidates nearest to their corners were added to
/// close it: those from position `added` on.
void mark_base(RepairedMesh& repaired, const PointCloud& candidates, std::size_t added);

/// Colour of each vertex: the weighted mean of the three nearest candidates.
void color_vertices(TriangleMesh& mesh, const PointCloud& candidates);

}  // namespace turnscan::surface
