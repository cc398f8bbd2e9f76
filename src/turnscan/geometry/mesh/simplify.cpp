#include <meshoptimizer.h>

#include <algorithm>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/mesh/mesh_edit.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>

namespace turnscan {

namespace {

constexpr int kTries = 5;

TriangleMesh collapse(const TriangleMesh& mesh, const SimplifyGoal& goal, std::size_t triangles) {
  const double extent = double(
      meshopt_simplifyScale(mesh.vertices.data()->data(), mesh.vertices.size(), sizeof(Vec3f)));
  const double relative = extent > 0.0 ? goal.max_error_m / extent : 0.0;
  std::vector<unsigned int> from, kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    auto& side = !goal.keep.empty() && goal.keep[i] != 0 ? kept : from;
    side.insert(side.end(), t.begin(), t.end());
  }
  std::vector<unsigned int> to(from.size());
  const std::size_t target = 3 * triangles - std::min(3 * triangles, kept.size());
  to.resize(meshopt_simplify(to.data(), from.data(), from.size(), mesh.vertices.data()->data(),
                             mesh.vertices.size(), sizeof(Vec3f), target,
                             static_cast<float>(std::min(relative, 1e10)),
                             kept.empty() ? 0 : meshopt_SimplifyLockBorder, nullptr));
  to.insert(to.end(), kept.begin(), kept.end());
  TriangleMesh out = mesh;
  out.triangles.clear();
  for (std::size_t i = 0; i + 2 < to.size(); i += 3)
    out.triangles.push_back({to[i], to[i + 1], to[i + 2]});
  mesh::compact_vertices(out);
  return out;
}

/// Collapses do not check whether edges fold together: cuts the surface there and closes the cuts.
/// nullopt if that does not give the original number of pieces.
Result<TriangleMesh> mend(const TriangleMesh& mesh, std::size_t pieces) {
  FillHolesOptions options;
  options.refine = false;
  TURNSCAN_ASSIGN(const TriangleMesh whole, repair(mesh, options, RunContext()));
  TURNSCAN_ASSIGN(std::vector<TriangleMesh> parts, split_components(whole));
  if (parts.size() < pieces) return fail(ErrorCode::kLibrary, "simplify: a piece is lost");
  parts.resize(pieces);  // the rest are folds of a few triangles
  TriangleMesh out = join_meshes(parts);
  out.name = mesh.name;
  if (!check_mesh(out).watertight()) return fail(ErrorCode::kLibrary, "simplify: still broken");
  return out;
}

}  // namespace

Result<TriangleMesh> collapse_edges(const TriangleMesh& mesh, const SimplifyGoal& goal) {
  TURNSCAN_TRY(validate_mesh(mesh));
  if (mesh.triangles.size() <= goal.triangles) return mesh;
  return collapse(mesh, goal, goal.triangles);
}

Result<TriangleMesh> simplify(const TriangleMesh& mesh, const SimplifyGoal& goal) {
  TURNSCAN_TRY(validate_mesh(mesh));
  const std::size_t n = mesh.triangles.size();
  std::size_t target = std::min(goal.triangles, n);
  if (mesh.empty() || target == n) return mesh;
  const MeshReport report = check_mesh(mesh);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    TriangleMesh out = collapse(mesh, goal, target);
    if (!out.empty() && (!report.watertight() || check_mesh(out).watertight())) return out;
    if (auto mended = mend(out, std::size_t(report.components)); mended) return *mended;
    // Collapses are made in order of error: fewer of them stop before the harmful one.
    target = std::max(target, out.triangles.size());
    target += (n - target) / 2;
  }
  return mesh;
}

}  // namespace turnscan
