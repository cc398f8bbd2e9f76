#pragma once
// Edits of a selected part of a mesh. A selection has one flag a triangle (else kInvalidOption; an
// empty one stands for the whole mesh); all fail with kFormat as validate_mesh(), and with
// kCancelled. Results keep a texture where triangles only go or move; of others its corners would
// no longer fit.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/selection/selection.hpp>

namespace turnscan {

/// The mesh without the selected triangles, and without the vertices that then nobody names.
Result<TriangleMesh> without_selected(const TriangleMesh& mesh, const Selection& selection);

struct HolesFilled {
  TriangleMesh mesh;
  std::size_t holes = 0;  ///< that were closed
};
/// Closes the holes at whose edge a selected triangle lies, as fill_holes() does; the others stay
/// as they are. Surfaces that touch at a vertex or an edge are cut apart there by make_manifold().
/// Fails as fill_holes() does.
Result<HolesFilled> fill_selected_holes(const TriangleMesh& mesh, const Selection& selection,
                                        const RunContext& context);

/// low_pass() of the selected part, whose edge stays where it is. The normals are made anew if
/// there were any.
Result<TriangleMesh> smooth_selected(const TriangleMesh& mesh, const Selection& selection,
                                     double wavelength_m, const RunContext& context);

/// As few triangles as `triangles` in the whole mesh, by those that are selected; see simplify().
Result<TriangleMesh> reduce_selected(const TriangleMesh& mesh, const Selection& selection,
                                     std::size_t triangles);

}  // namespace turnscan
