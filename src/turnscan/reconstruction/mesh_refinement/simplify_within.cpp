#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/reconstruction/mesh_refinement/simplify_within.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr int kTries = 10;
constexpr int kRingsKept = 3;  ///< of triangles around a vertex that deviates too far
/// Share of vertices: if more deviate too far, the bound on the quadrics is too large.
constexpr double kFewStrays = 0.01;
/// Folds that remain after this many tries existed before.
constexpr int kTriesWithoutFolds = 3;

/// The vertices of triangles that face against their vertices' normals, one flag each.
std::vector<std::uint8_t> folded_vertices(const TriangleMesh& mesh) {
  std::vector<std::uint8_t> out(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3f outward = mesh.normals[a] + mesh.normals[b] + mesh.normals[c];
    if (mesh::doubled_area_normal(mesh, t).dot(outward.cast<double>()) < 0.0)
      for (const std::uint32_t v : mesh.triangles[t]) out[v] = 1;
  }
  return out;
}

/// The vertices of triangles that may be removed, one flag each.
std::vector<std::uint8_t> free_vertices(const TriangleMesh& full,
                                        const std::vector<std::uint8_t>& keep) {
  std::vector<std::uint8_t> out(full.vertices.size(), 0);
  for (std::size_t t = 0; t < keep.size(); ++t)
    if (keep[t] == 0)
      for (const std::uint32_t v : full.triangles[t]) out[v] = 1;
  return out;
}

constexpr std::uint8_t kFar = 1, kFolded = 2;

/// Flags of the vertices that are farther from the other mesh than the limit (these have no nearest
/// triangle), of those where it is broken, and of the free ones where it is folded. The other mesh
/// has the full one's normals.
std::vector<std::uint8_t> strays_of(const std::vector<std::uint8_t>& free,
                                    const SimplifiedMesh& fewer,
                                    const std::vector<std::uint8_t>& broken) {
  const std::vector<std::uint8_t> folded = folded_vertices(fewer.mesh);
  std::vector<std::uint8_t> out(fewer.nearest.size(), 0);
  parallel_for(out.size(), 1024, [&](std::size_t v) {
    const std::uint32_t nearest = fewer.nearest[v].triangle;
    if (nearest == MeshDistance::kNone) {
      out[v] = kFar;
      return;
    }
    const auto& corners = fewer.mesh.triangles[nearest];
    const auto marked = [&](const std::vector<std::uint8_t>& marks) {
      return std::any_of(corners.begin(), corners.end(), [&](auto c) { return marks[c] != 0; });
    };
    if (marked(broken) || (free[v] != 0 && marked(folded))) out[v] = kFolded;
  });
  return out;
}

/// Marks the triangles of some rings around vertices.
void keep_about(const TriangleMesh& mesh, std::vector<std::uint8_t> vertices,
                std::vector<std::uint8_t>& keep) {
  for (int ring = 0; ring < kRingsKept; ++ring) {
    std::vector<std::size_t> touched;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto& corners = mesh.triangles[t];
      if (std::any_of(corners.begin(), corners.end(), [&](auto v) { return vertices[v] != 0; }))
        touched.push_back(t);
    }
    for (const std::size_t t : touched) {
      keep[t] = 1;
      for (const auto v : mesh.triangles[t]) vertices[v] = 1;
    }
  }
}

}  // namespace

/// Quadrics only estimate the deviation of a surface: the deviation is measured, and simplification
/// repeated with a smaller bound, or, if it is too large in only a few places, with those kept
/// unchanged, as are those where edges fold together.
Result<SimplifiedMesh> simplify_within(const TriangleMesh& full, const SimplifyGoal& asked,
                                       double max_distance_m, const RunContext& context) {
  TriangleMesh with_normals = full;
  with_normals.normals = vertex_normals(full);
  const bool watertight = check_mesh(full).watertight();
  SimplifyGoal goal = asked;
  goal.keep.resize(full.triangles.size(), 0);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    SimplifiedMesh fewer;
    TURNSCAN_ASSIGN(fewer.mesh, collapse_edges(with_normals, goal));
    TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(fewer.mesh, context));
    fewer.nearest.resize(full.vertices.size());
    TURNSCAN_TRY(parallel_for(full.vertices.size(), 256, context, [&](std::size_t v) {
      fewer.nearest[v] = distance.closest(full.vertices[v].cast<double>(), max_distance_m);
    }));
    std::vector<std::uint8_t> broken;
    const bool whole = check_mesh(fewer.mesh, &broken).watertight();
    if (!watertight) broken.assign(broken.size(), 0);
    const auto free = attempt < kTriesWithoutFolds
                          ? free_vertices(full, goal.keep)
                          : std::vector<std::uint8_t>(full.vertices.size(), 0);
    auto strays = strays_of(free, fewer, broken);
    if (std::all_of(strays.begin(), strays.end(), [](auto stray) { return stray == 0; })) {
      if (watertight && !whole) break;
      if (full.normals.empty()) fewer.mesh.normals.clear();
      return fewer;
    }
    const auto far = std::count(strays.begin(), strays.end(), kFar);
    if (double(far) > kFewStrays * double(strays.size())) {
      goal.max_error_m *= 0.5;
    } else {
      keep_about(full, std::move(strays), goal.keep);
    }
  }
  return SimplifiedMesh{full, {}};
}

}  // namespace turnscan::mesh_refinement
