#pragma once
// Vertex colours from the views that saw the vertices.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::mesh_refinement {

/// Gives each vertex the mean colour of the pixels in which views measured it, of up to 256 evenly
/// spread views: those within tolerance_m of the measured depth, and not beside an edge. A view is
/// weighted by the fourth power of the cosine between its ray and the vertex's normal, so that
/// frontal views dominate. Black pixels have no colour. Vertices that no view saw take the mean of
/// their coloured neighbours, from the border inwards. Returns whether there is any colour; if not,
/// the mesh gets none. Fails with kCancelled. The result is byte-identical for any number of
/// threads.
Result<bool> color_from_views(TriangleMesh& mesh, std::span<const views::DepthView> views,
                              double tolerance_m, const RunContext& context);

/// Colour of invented surface: between magenta and red, which rarely occurs otherwise.
inline constexpr Rgb kInventedColor{255, 0, 144};

/// Paints the vertices of invented triangles; a mesh without colours first becomes light grey.
void paint_invented(TriangleMesh& mesh, const std::vector<Evidence>& evidence);

}  // namespace turnscan::mesh_refinement
