#pragma once
// Takes back what a depth camera's filter did to edges and thin parts.

#include <turnscan/reconstruction/mesh_refinement/mesh_fit.hpp>

namespace turnscan::mesh_refinement {

/// A camera that averages over neighbouring pixels sees edges rounded and rims farther back than
/// they are, and so is a mesh that was fitted to its depths. The mesh is drawn as up to 64 of the
/// views would see it through the filter; by as much as that lies off what was measured the
/// vertices move the other way (Van Cittert 1931; one step, since a second one frays rims). The
/// far side of thin parts does not follow inwards where it was hardly measured. share: of each
/// neighbour along a row and along a column (share_of_neighbours). The same bytes for any number of
/// threads. Fails with kCancelled, and then leaves the mesh as it was.
Result<> sharpen_mesh(TriangleMesh& mesh, std::span<const views::DepthView> views, double share,
                      const MeshFitScale& scale, const RunContext& context);

}  // namespace turnscan::mesh_refinement
