#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/mesh/vertex_neighbours.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit.hpp>
#include <turnscan/reconstruction/quality/expected_error.hpp>
#include <turnscan/reconstruction/quality/thin_walls.hpp>

namespace turnscan::quality {

namespace {

/// Fitted to simulated scans (bench/expected_error). The share of the noise is of a fit that could
/// not tell its own.
constexpr double kNoiseShare = 0.22, kHiddenShare = 0.4;
constexpr double kFitBlur = 0.52, kFilteredBlur = 0.5;
constexpr double kMixedShare = 0.65;
/// Behind a filter, relative to the distance between pixels, at walls thinner than two of them.
constexpr double kThinShare = 0.17, kThinPixels = 2.0;

/// Distance along edges of the mesh to the nearest measured vertex (Dijkstra 1959); metres.
std::vector<float> way_to_measured(const TriangleMesh& mesh, const mesh::VertexNeighbours& beside,
                                   const std::vector<float>& support) {
  const std::vector<std::uint8_t> unseen = mesh_refinement::unseen_vertices(support);
  std::vector<float> way(mesh.vertices.size(), std::numeric_limits<float>::max());
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](std::uint32_t v, float length) {
    if (length >= way[v]) return;
    way[v] = length;
    queue.push({length, v});
  };
  for (std::uint32_t v = 0; v < way.size(); ++v)
    if (!unseen[v]) reach(v, 0.0f);
  while (!queue.empty()) {
    const auto [length, v] = queue.top();
    queue.pop();
    if (length > way[v]) continue;
    for (const std::uint32_t other : beside.of(v))
      reach(other, length + (mesh.vertices[v] - mesh.vertices[other]).norm());
  }
  return way;
}

/// Angle between the normals of neighbours over their distance, radians per metre.
double bending_at(const TriangleMesh& mesh, const std::vector<Vec3f>& normals,
                  const mesh::VertexNeighbours& beside, std::uint32_t v) {
  double angle = 0.0, length = 0.0;
  for (const std::uint32_t other : beside.of(v)) {
    angle += std::acos(std::clamp(normals[v].dot(normals[other]), -1.0f, 1.0f));
    length += (mesh.vertices[v] - mesh.vertices[other]).norm();
  }
  return length > 0.0 ? angle / length : 0.0;
}

/// Factor from a bend, as an angle per length, to the distance that is lost.
double blurring_window_m2(const ErrorScale& scale) {
  if (scale.filtered) return kFilteredBlur * scale.spacing_m * scale.spacing_m;
  // Bends beyond the noise are creases, which the fit spares: less noise reveals finer detail.
  return kFitBlur * scale.edge_m * scale.edge_m * std::sqrt(scale.noise_m / scale.spacing_m);
}

}  // namespace

std::vector<float> expected_errors(const TriangleMesh& mesh, const std::vector<float>& support,
                                   const ErrorScale& scale) {
  const mesh::VertexNeighbours beside(mesh);
  const auto normals = vertex_normals(mesh);
  const auto way = way_to_measured(mesh, beside, support);
  const double typical = mesh_refinement::typical_support(support);
  const double noise_share = scale.noise_share.value_or(kNoiseShare);
  std::optional<ThinWalls> walls;
  if (scale.filtered) walls.emplace(mesh, normals);
  const double window_m2 = blurring_window_m2(scale);
  std::vector<float> out(mesh.vertices.size());
  parallel_for(out.size(), 1024, [&](std::size_t v) {
    const double bend = bending_at(mesh, normals, beside, std::uint32_t(v));
    const double noise = noise_share * scale.noise_m / std::sqrt(1.0 + double(support[v]));
    const double blur = window_m2 * bend;
    const double lacking = std::max(0.0, 1.0 - double(support[v]) / typical);
    const double mixed = scale.filtered ? kMixedShare * scale.noise_m * lacking : 0.0;
    const double hidden = kHiddenShare * double(way[v]);
    const double thin = walls && walls->thinner_than(kThinPixels * scale.spacing_m, v)
                            ? kThinShare * scale.spacing_m
                            : 0.0;
    double squares = 0.0;
    for (const double part : {noise, blur, mixed, hidden, thin}) squares += part * part;
    out[v] = float(std::sqrt(squares));
  });
  return out;
}

}  // namespace turnscan::quality
