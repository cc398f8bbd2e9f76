#pragma once
// What people and programs are told about a mesh.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/mesh_check.hpp>

namespace turnscan::cli {

/// "155.7 x 154.3 x 120.7 mm"
std::string size_text(const Box& box);
/// One plain sentence per property: closed, 2-manifold, outward, and what that means for printing.
std::string check_sentences(const MeshReport& report);
/// Counts, size, area, volume and checks; SI units in the names.
nlohmann::json mesh_json(const TriangleMesh& mesh, const MeshReport& report);

}  // namespace turnscan::cli
