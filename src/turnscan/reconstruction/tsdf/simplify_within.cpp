#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/reconstruction/tsdf/simplify_within.hpp>

namespace turnscan::tsdf {

namespace {

/// Distance of the vertex of one mesh that lies farthest from another mesh.
double farthest_vertex(const TriangleMesh& from, const TriangleMesh& to) {
  const MeshDistance distance(to);
  std::vector<double> distances(from.vertices.size());
  parallel_for(distances.size(), 256, [&](std::size_t v) {
    distances[v] = distance.closest(from.vertices[v].cast<double>()).distance;
  });
  return distances.empty() ? 0.0 : *std::max_element(distances.begin(), distances.end());
}

}  // namespace

/// Quadrics only estimate how far a surface strays: it is measured, and tried again with a smaller
/// bound, then by bisection.
Result<TriangleMesh> simplify_within(const TriangleMesh& full, std::size_t triangles,
                                     double max_error_m, const RunContext& context) {
  constexpr int kTries = 6;
  TriangleMesh best = full;
  double goal = max_error_m, enough = 0.0, too_much = 0.0;
  for (int attempt = 0; attempt < kTries; ++attempt) {
    TURNSCAN_ASSIGN(TriangleMesh fewer, simplify(full, {triangles, goal, false}));
    TURNSCAN_TRY(context.check());
    const double farthest = farthest_vertex(full, fewer);
    (farthest <= max_error_m ? enough : too_much) = goal;
    if (farthest <= max_error_m && fewer.triangles.size() < best.triangles.size())
      best = std::move(fewer);
    if (too_much == 0.0) break;
    goal = enough > 0.0 ? 0.5 * (enough + too_much) : goal * 0.9 * max_error_m / farthest;
  }
  return best;
}

}  // namespace turnscan::tsdf
