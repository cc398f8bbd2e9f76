#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/hole_patch.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>

namespace turnscan {
namespace {

using mesh::EdgeTable;
using mesh::HolePatch;
using mesh::kNone;
using mesh::next_in_triangle;
using mesh::origin;
using VertexPair = std::pair<std::uint32_t, std::uint32_t>;

/// Border of a mesh as required for filling.
struct Border {
  std::vector<std::vector<std::uint32_t>> loops;  ///< vertices, in the direction of the patches
  std::vector<VertexPair> edges;  ///< (smaller, larger) with both ends on a border, sorted
  std::vector<double> scale;      ///< per vertex on a border: mean length of its edges

  bool joins(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(edges.begin(), edges.end(), VertexPair(std::minmax(a, b)));
  }
};

std::uint32_t target(const TriangleMesh& mesh, std::uint32_t h) {
  return origin(mesh, next_in_triangle(h));
}

/// In a manifold one open half edge leaves each border vertex, so that loops are simple.
std::vector<std::vector<std::uint32_t>> trace_loops(const TriangleMesh& mesh,
                                                    const EdgeTable& edges) {
  std::vector<std::uint32_t> leaving(mesh.vertices.size(), kNone);
  std::vector<std::uint32_t> open;
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto around = edges.half_edges(e);
    if (around.size() != 1) continue;
    open.push_back(around[0]);
    leaving[origin(mesh, around[0])] = around[0];
  }
  std::sort(open.begin(), open.end());
  std::vector<std::vector<std::uint32_t>> loops;
  for (const std::uint32_t start : open) {
    if (leaving[origin(mesh, start)] == kNone) continue;
    std::vector<std::uint32_t> loop;
    for (std::uint32_t v = origin(mesh, start); leaving[v] != kNone;) {
      const std::uint32_t h = leaving[v];
      leaving[v] = kNone;
      loop.push_back(v);
      v = target(mesh, h);
    }
    std::reverse(loop.begin(), loop.end());  // the patch traverses its edges in the opposite
                                             // direction
    loops.push_back(std::move(loop));
  }
  return loops;
}

Border find_border(const TriangleMesh& mesh) {
  const EdgeTable edges(mesh.triangles, mesh.vertices.size());
  Border border;
  border.loops = trace_loops(mesh, edges);
  border.scale.assign(mesh.vertices.size(), 0.0);
  std::vector<std::uint8_t> on_border(mesh.vertices.size(), 0);
  for (const auto& loop : border.loops) {
    for (const std::uint32_t v : loop) on_border[v] = 1;
  }
  std::vector<std::uint32_t> degree(mesh.vertices.size(), 0);
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const std::uint32_t h = edges.half_edges(e)[0];
    const std::uint32_t ends[2] = {origin(mesh, h), target(mesh, h)};
    if (on_border[ends[0]] != 0 && on_border[ends[1]] != 0) {
      border.edges.push_back(std::minmax(ends[0], ends[1]));
    }
    const double length = (mesh.vertices[ends[0]] - mesh.vertices[ends[1]]).cast<double>().norm();
    for (const std::uint32_t v : ends) {
      if (on_border[v] == 0) continue;
      border.scale[v] += length;
      ++degree[v];
    }
  }
  for (std::size_t v = 0; v < degree.size(); ++v) border.scale[v] /= std::max(degree[v], 1u);
  std::sort(border.edges.begin(), border.edges.end());
  return border;
}

HolePatch make_patch(const TriangleMesh& mesh, const Border& border,
                     const std::vector<std::uint32_t>& loop, bool refine) {
  std::vector<Vec3d> points;
  std::vector<double> scale;
  for (const std::uint32_t v : loop) {
    points.push_back(mesh.vertices[v].cast<double>());
    scale.push_back(border.scale[v]);
  }
  const auto taken = [&](std::uint32_t a, std::uint32_t b) {
    return border.joins(loop[a], loop[b]);
  };
  HolePatch patch = mesh::triangulate_loop(std::move(points), taken);
  if (refine) mesh::refine_patch(patch, std::move(scale), taken);
  return patch;
}

void add_patch(TriangleMesh& mesh, const std::vector<std::uint32_t>& loop, const HolePatch& patch) {
  std::vector<std::uint32_t> place = loop;
  for (std::size_t i = loop.size(); i < patch.points.size(); ++i) {
    const auto& parents = patch.parents[i - loop.size()];
    const std::uint32_t of[3] = {place[parents[0]], place[parents[1]], place[parents[2]]};
    place.push_back(mesh::add_mean_vertex(mesh, of));
    mesh.vertices.back() = patch.points[i].cast<float>();
  }
  for (const auto& [a, b, c] : patch.triangles) {
    mesh.triangles.push_back({place[a], place[b], place[c]});
  }
}

/// Drops pieces with hardly any volume: two sheets face to face.
Result<TriangleMesh> drop_flat_pieces(const TriangleMesh& mesh) {
  TURNSCAN_ASSIGN(std::vector<TriangleMesh> pieces, split_components(mesh));
  std::erase_if(pieces, [](const TriangleMesh& piece) {
    const MeshReport report = check_mesh(piece);
    return !(report.volume_m3 > 1e-9 * std::pow(report.area_m2, 1.5));
  });
  TriangleMesh rest = join_meshes(pieces);
  rest.name = mesh.name;
  return rest;
}

}  // namespace

Result<FilledMesh> fill_holes(const TriangleMesh& mesh, const FillHolesOptions& options,
                              const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  RelaxOptions relaxing;
  relaxing.tension = options.tension;
  TURNSCAN_TRY(describe(relaxing).check());
  const MeshReport report = check_mesh(mesh);
  if (!report.manifold || !report.oriented) {
    return fail(ErrorCode::kFormat, "fill holes: the mesh is {}; make it manifold first",
                report.text());
  }
  Border border = find_border(mesh);
  std::erase_if(border.loops, [&](const auto& loop) { return loop.size() > options.max_edges; });
  std::vector<HolePatch> patches(border.loops.size());
  TURNSCAN_TRY(parallel_for(patches.size(), 1, context, [&](std::size_t i) {
    patches[i] = make_patch(mesh, border, border.loops[i], options.refine);
  }));
  FilledMesh filled{mesh, std::vector<std::uint8_t>(mesh.triangles.size(), 0), patches.size()};
  for (std::size_t i = 0; i < patches.size(); ++i) {
    add_patch(filled.mesh, border.loops[i], patches[i]);
  }
  filled.filled.resize(filled.mesh.triangles.size(), 1);
  if (!options.fair) return filled;
  std::vector<std::uint8_t> movable(filled.mesh.vertices.size(), 0);
  std::fill(movable.begin() + std::ptrdiff_t(mesh.vertices.size()), movable.end(), 1);
  TURNSCAN_ASSIGN(filled.mesh, relax(filled.mesh, movable, relaxing, context));
  return filled;
}

Result<TriangleMesh> repair(const TriangleMesh& mesh, const FillHolesOptions& options,
                            const RunContext& context) {
  TURNSCAN_ASSIGN(TriangleMesh fixed, merge_vertices(mesh));
  TURNSCAN_ASSIGN(fixed, remove_degenerate(fixed));
  TURNSCAN_ASSIGN(fixed, orient_consistently(fixed));
  TURNSCAN_ASSIGN(fixed, make_manifold(fixed));
  TURNSCAN_TRY(context.check());
  TURNSCAN_ASSIGN(FilledMesh filled, fill_holes(fixed, options, context));
  TURNSCAN_ASSIGN(fixed, orient_outward(filled.mesh));
  TURNSCAN_ASSIGN(fixed, drop_flat_pieces(fixed));
  if (fixed.empty()) {
    return fail(ErrorCode::kTooFewPoints,
                "repair a mesh: nothing of it encloses a volume; check the mesh");
  }
  const MeshReport report = check_mesh(fixed);
  if (!report.watertight()) {
    return fail(ErrorCode::kLibrary, "repair a mesh: the result is {}; wrap the mesh instead",
                report.text());
  }
  return fixed;
}

}  // namespace turnscan
