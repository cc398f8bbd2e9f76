#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/reconstruction/mesh_refinement/simplify_within.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr int kTries = 10;
constexpr int kRingsKept = 3;  ///< of triangles about a vertex that strays too far
/// Of the vertices: where more stray too far, the bound on the quadrics is too wide.
constexpr double kFewStrays = 0.01;

/// The vertices that lie farther from the other mesh than that, one flag each.
std::vector<std::uint8_t> strays_of(const TriangleMesh& full, const TriangleMesh& fewer,
                                    double max_error_m) {
  const MeshDistance distance(fewer);
  std::vector<std::uint8_t> out(full.vertices.size());
  parallel_for(out.size(), 256, [&](std::size_t v) {
    out[v] = distance.closest(full.vertices[v].cast<double>()).distance > max_error_m ? 1 : 0;
  });
  return out;
}

/// Marks the triangles of some rings about vertices.
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

/// Quadrics only estimate how far a surface strays: it is measured, and tried again with a smaller
/// bound, or where it strays in a few places with those left as they are.
Result<TriangleMesh> simplify_within(const TriangleMesh& full, std::size_t triangles,
                                     double max_error_m, const RunContext& context) {
  SimplifyGoal goal{triangles, max_error_m, false,
                    std::vector<std::uint8_t>(full.triangles.size(), 0)};
  for (int attempt = 0; attempt < kTries; ++attempt) {
    TURNSCAN_ASSIGN(TriangleMesh fewer, simplify(full, goal));
    TURNSCAN_TRY(context.check());
    auto strays = strays_of(full, fewer, max_error_m);
    const auto count = std::size_t(std::count(strays.begin(), strays.end(), 1));
    if (count == 0) return fewer;
    if (double(count) > kFewStrays * double(strays.size())) {
      goal.max_error_m *= 0.5;
    } else {
      keep_about(full, std::move(strays), goal.keep);
    }
  }
  return full;
}

}  // namespace turnscan::mesh_refinement
