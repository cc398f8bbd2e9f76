#pragma once
// Descriptions of a mesh as text and JSON.

#include <string>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <vector>

namespace turnscan {

/// "155.7 x 154.3 x 120.7 mm"
std::string size_text(const Box& box);

/// One plain sentence per property: closed, 2-manifold, outward, and the consequence for printing.
std::string check_sentences(const MeshReport& report);

/// A JSON object {"kind": "mesh", "objects": [...]} with counts, size, area, volume and checks of
/// each mesh; SI units as named by the keys. reports: check_surface() of each.
std::string meshes_json(const std::vector<TriangleMesh>& meshes,
                        const std::vector<MeshReport>& reports);

}  // namespace turnscan
