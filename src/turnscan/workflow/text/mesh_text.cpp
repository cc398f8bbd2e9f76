#include <turnscan/workflow/text/mesh_text.hpp>

#include <turnscan/core/mesh_texture.hpp>

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace turnscan {

namespace {

std::string closed_sentence(const MeshReport& r) {
  if (r.closed) return "It is closed.";
  if (r.triangles == 0) return "It is not closed: it has no triangles.";
  return fmt::format("It is not closed: {} edges have a triangle on one side only.",
                     r.boundary_edges);
}

std::string manifold_sentence(const MeshReport& r) {
  if (r.manifold) return "It is 2-manifold: every edge and vertex has one sheet of surface.";
  return fmt::format(
      "It is not 2-manifold: {} edges have three or more triangles, {} vertices join several "
      "sheets, {} triangles are invalid, {} repeat a vertex.",
      r.non_manifold_edges, r.non_manifold_vertices, r.invalid_triangles, r.repeated_vertices);
}

std::string outward_sentence(const MeshReport& r) {
  if (!r.oriented)
    return fmt::format("Its triangles do not agree on a side: {} edges run the same way twice.",
                       r.misoriented_edges);
  if (!r.closed) return "Its triangles agree on a side; without closing there is no outside.";
  return r.outward ? "Its triangles face outward." : "Its triangles face inward.";
}

std::string crossing_sentence(const MeshReport& r) {
  if (r.crossing_edges == 0) return "It does not pass through itself.";
  return fmt::format("It passes through itself: {} edges pass through other triangles.",
                     r.crossing_edges);
}

nlohmann::json mesh_json(const TriangleMesh& mesh, const MeshReport& r) {
  const Vec3d size = bounds(mesh.vertices).size();
  return {{"name", mesh.name},
          {"vertices", r.vertices},
          {"triangles", r.triangles},
          {"pieces", r.components},
          {"size_m", {size.x(), size.y(), size.z()}},
          {"area_m2", r.area_m2},
          {"volume_m3", r.volume_m3},
          {"closed", r.closed},
          {"manifold", r.manifold},
          {"oriented", r.oriented},
          {"outward", r.outward},
          {"watertight", r.watertight()},
          {"boundary_edges", r.boundary_edges},
          {"non_manifold_edges", r.non_manifold_edges},
          {"crossing_edges", r.crossing_edges},
          {"non_manifold_vertices", r.non_manifold_vertices},
          {"misoriented_edges", r.misoriented_edges},
          {"invalid_triangles", r.invalid_triangles},
          {"degenerate_triangles", r.degenerate_triangles},
          {"colored", !mesh.colors.empty()},
          {"texture_px", has_texture(mesh)
                             ? nlohmann::json{mesh.texture->image.width, mesh.texture->image.height}
                             : nlohmann::json()}};
}

}  // namespace

std::string size_text(const Box& box) {
  const Vec3d mm = box.size() * 1e3;
  return fmt::format("{:.1f} x {:.1f} x {:.1f} mm", mm.x(), mm.y(), mm.z());
}

std::string check_sentences(const MeshReport& r) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n", closed_sentence(r), manifold_sentence(r),
                     outward_sentence(r), crossing_sentence(r),
                     r.watertight() ? "It is watertight. How much of it was measured is in the "
                                      "output of turnscan reconstruct."
                                    : "It is not watertight; a printer's software may refuse it.");
}

std::string meshes_json(const std::vector<TriangleMesh>& meshes,
                        const std::vector<MeshReport>& reports) {
  nlohmann::json objects = nlohmann::json::array();
  for (std::size_t i = 0; i < meshes.size(); ++i)
    objects.push_back(mesh_json(meshes[i], reports.at(i)));
  return nlohmann::json{{"kind", "mesh"}, {"objects", objects}}.dump(2);
}

}  // namespace turnscan
