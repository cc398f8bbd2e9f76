#pragma once
// Compensates the effect of a depth camera's filter on edges and thin parts.

#include <turnscan/reconstruction/mesh_refinement/mesh_fit.hpp>

namespace turnscan::mesh_refinement {

/// A camera that averages over neighbouring pixels rounds edges and shifts rims backwards, and so
/// is a mesh fitted to its depths. Renders the mesh as up to 64 of the views would see it through
/// the filter, and moves the vertices opposite to its deviation from the measurements (Van Cittert
/// 1931; one step, since a second one frays rims). The far side of thin parts does not follow
/// inwards where it was hardly measured. share: of each neighbour along a row and along a column
/// (share_of_neighbours). The result is byte-identical for any number of threads. Fails with
/// kCancelled, and then leaves the mesh unchanged.
Result<> sharpen_mesh(TriangleMesh& mesh, std::span<const views::DepthView> views, double share,
                      const MeshFitScale& scale, const RunContext& context);

}  // namespace turnscan::mesh_refinement
