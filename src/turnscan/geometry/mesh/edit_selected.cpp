#include <turnscan/geometry/mesh/edit_selected.hpp>

#include <turnscan/core/disjoint_sets.hpp>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/low_pass.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>

namespace turnscan {

namespace {

Result<> check_input(const TriangleMesh& mesh, const Selection& selection) {
  TURNSCAN_TRY(validate_mesh(mesh, "edit"));
  if (selection.empty() || selection.size() == mesh.triangles.size()) return {};
  return fail(ErrorCode::kInvalidOption,
              "edit: {} flags do not fit the mesh's {} triangles; select them anew",
              selection.size(), mesh.triangles.size());
}

TriangleMesh untextured(TriangleMesh mesh) {
  mesh.texture = nullptr;
  return mesh;
}

/// The texture of the remaining triangles, if the mesh has one.
std::shared_ptr<const MeshTexture> texture_of_rest(const TriangleMesh& mesh,
                                                   const Selection& dropped) {
  if (!has_texture(mesh)) return nullptr;
  auto out = std::make_shared<MeshTexture>();
  out->image = mesh.texture->image;
  for (std::size_t t = 0; t < dropped.size(); ++t)
    if (dropped[t] == 0) out->corners.push_back(mesh.texture->corners[t]);
  return out;
}

/// Deletion leaves surfaces that touch at a vertex: separated there, each has holes of its own. The
/// order of the triangles is preserved; otherwise the mesh is returned unchanged.
Result<TriangleMesh> cut_where_touching(const TriangleMesh& mesh) {
  TriangleMesh plain = untextured(mesh);
  if (check_mesh(plain).manifold) return plain;
  TURNSCAN_ASSIGN(TriangleMesh cut, make_manifold(plain));
  return cut.triangles.size() == plain.triangles.size() ? cut : plain;
}

}  // namespace

Result<TriangleMesh> without_selected(const TriangleMesh& mesh, const Selection& selection) {
  TURNSCAN_TRY(check_input(mesh, selection));
  TriangleMesh out = untextured(mesh);
  const Selection all(selection.empty() ? mesh.triangles.size() : 0, 1);
  const Selection& dropped = selection.empty() ? all : selection;
  mesh::drop_triangles(out, dropped);
  mesh::compact_vertices(out);
  out.texture = texture_of_rest(mesh, dropped);
  return out;
}

Result<HolesFilled> fill_selected_holes(const TriangleMesh& mesh, const Selection& selection,
                                        const RunContext& context) {
  TURNSCAN_TRY(check_input(mesh, selection));
  TURNSCAN_ASSIGN(const TriangleMesh apart, cut_where_touching(mesh));
  TURNSCAN_ASSIGN(FilledMesh made, fill_holes(apart, {}, context));
  if (selection.empty()) return HolesFilled{std::move(made.mesh), made.holes};
  // A patch is an edge-connected component; it is kept if one of its edges belongs to a selected
  // triangle. fill_holes() keeps the original triangles at the front.
  const auto count = std::uint32_t(made.mesh.triangles.size());
  DisjointSets patches(count);
  std::vector<std::array<std::uint32_t, 2>> rims;  // of the patch, and of the surrounding mesh
  const mesh::EdgeTable edges(made.mesh.triangles, made.mesh.vertices.size());
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto half_edges = edges.half_edges(e);
    if (half_edges.size() != 2) continue;
    const std::uint32_t t = half_edges[0] / 3, u = half_edges[1] / 3;
    const bool t_new = made.filled[t] != 0, u_new = made.filled[u] != 0;
    if (t_new && u_new) patches.join(t, u);
    if (t_new != u_new) rims.push_back(t_new ? std::array{t, u} : std::array{u, t});
  }
  std::vector<std::uint8_t> wanted(count, 0);
  for (const auto& [patch, around] : rims)
    if (around < selection.size() && selection[around] != 0) wanted[patches.root(patch)] = 1;
  HolesFilled out;
  Selection drop(count, 0);
  for (std::uint32_t t = 0; t < count; ++t) {
    if (made.filled[t] == 0) continue;
    const bool stays = wanted[patches.root(t)] != 0;
    drop[t] = stays ? 0 : 1;
    out.holes += stays && patches.root(t) == t ? 1 : 0;
  }
  out.mesh = std::move(made.mesh);
  mesh::drop_triangles(out.mesh, drop);
  mesh::compact_vertices(out.mesh);
  return out;
}

Result<TriangleMesh> smooth_selected(const TriangleMesh& mesh, const Selection& selection,
                                     double wavelength_m, const RunContext& context) {
  TURNSCAN_TRY(check_input(mesh, selection));
  if (!(wavelength_m > 0.0)) {
    return fail(ErrorCode::kInvalidOption,
                "smooth: a wavelength of {} mm is not allowed; give one above 0",
                1e3 * wavelength_m);
  }
  if (selection.empty()) {
    TURNSCAN_ASSIGN(TriangleMesh all, low_pass(untextured(mesh), wavelength_m, context));
    all.texture = mesh.texture;
    return all;
  }
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint8_t> used(mesh.vertices.size(), 0);
  for (std::uint32_t t = 0; t < selection.size(); ++t) {
    if (selection[t] == 0) continue;
    triangles.push_back(t);
    for (const std::uint32_t v : mesh.triangles[t]) used[v] = 1;
  }
  TURNSCAN_ASSIGN(const TriangleMesh part,
                  low_pass(mesh::extract(mesh, triangles), wavelength_m, context));
  TriangleMesh out = mesh;
  // The vertices of the part are in the order of the mesh.
  for (std::size_t v = 0, next = 0; v < used.size(); ++v)
    if (used[v] != 0) out.vertices[v] = part.vertices[next++];
  if (!out.normals.empty()) out.normals = vertex_normals(out);
  return out;
}

Result<TriangleMesh> reduce_selected(const TriangleMesh& mesh, const Selection& selection,
                                     std::size_t triangles) {
  TURNSCAN_TRY(check_input(mesh, selection));
  SimplifyGoal goal;
  goal.triangles = triangles;
  if (!selection.empty()) goal.keep = inverted(selection);
  return simplify(untextured(mesh), goal);
}

}  // namespace turnscan
