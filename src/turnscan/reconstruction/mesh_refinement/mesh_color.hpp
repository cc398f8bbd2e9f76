#pragma once
// Colour of a mesh's vertices from the views that saw them.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::mesh_refinement {

/// Gives each vertex the mean colour of the pixels in which views measured it, up to 256 of them
/// evenly spread: within tolerance_m of the depth they measured, not beside an edge. A view counts
/// by the fourth power of the cosine between its ray and the vertex's normal, so that what is seen
/// from the front decides. Black pixels have no colour. Vertices that no view saw take the mean of
/// their coloured neighbours, from the border inwards. Whether there is any colour; if not, the
/// mesh gets none. Fails with kCancelled. The same bytes for any number of threads.
Result<bool> color_from_views(TriangleMesh& mesh, std::span<const views::DepthView> views,
                              double tolerance_m, const RunContext& context);

/// What is marked as invented: between magenta and red, as nothing else is.
inline constexpr Rgb kInventedColor{255, 0, 144};

/// Paints the vertices of invented triangles; a mesh without colours becomes light grey first.
void paint_invented(TriangleMesh& mesh, const std::vector<Evidence>& evidence);

}  // namespace turnscan::mesh_refinement
