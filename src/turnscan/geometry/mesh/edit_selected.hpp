#pragma once
// Edits of a selected part of a mesh. A selection has one flag per triangle (else kInvalidOption;
// an empty one stands for the whole mesh); all functions fail with kFormat as validate_mesh(), and
// with kCancelled. Results keep a texture if triangles are only removed or moved; otherwise its
// corners would no longer match.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/selection/selection.hpp>

namespace turnscan {

/// The mesh without the selected triangles, and without the vertices that are then unreferenced.
Result<TriangleMesh> without_selected(const TriangleMesh& mesh, const Selection& selection);

struct HolesFilled {
  TriangleMesh mesh;
  std::size_t holes = 0;  ///< number of holes closed
};
/// Closes the holes with a selected triangle at their boundary, as fill_holes() does; the others
/// are unchanged. Surfaces that touch at a vertex or an edge are separated there by
/// make_manifold(). Fails as fill_holes() does.
Result<HolesFilled> fill_selected_holes(const TriangleMesh& mesh, const Selection& selection,
                                        const RunContext& context);

/// low_pass() of the selected part, whose boundary stays fixed. Normals are recomputed if there
/// were any.
Result<TriangleMesh> smooth_selected(const TriangleMesh& mesh, const Selection& selection,
                                     double wavelength_m, const RunContext& context);

/// Simplifies the selected triangles until the whole mesh has only `triangles`; see simplify().
Result<TriangleMesh> reduce_selected(const TriangleMesh& mesh, const Selection& selection,
                                     std::size_t triangles);

}  // namespace turnscan
