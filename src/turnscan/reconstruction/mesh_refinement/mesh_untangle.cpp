#include <algorithm>
#include <iterator>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_untangle.hpp>

namespace turnscan::mesh_refinement {

namespace {

constexpr std::size_t kSmallSteps = 24;
constexpr float kSmallStep = 0.3f;
constexpr int kSmallStepRings = 6;
constexpr int kWholeWayRings[] = {12, 24, 48};
constexpr int kMostSmoothedRings = 24;

}  // namespace

bool any_marked(const std::vector<std::uint8_t>& marks) {
  return std::find(marks.begin(), marks.end(), 1) != marks.end();
}

std::vector<std::uint8_t> crossing_vertices(const TriangleMesh& mesh,
                                            const std::vector<std::uint8_t>& before,
                                            std::span<const std::uint8_t> moved) {
  const std::vector<std::uint8_t> faults = self_intersections(mesh, moved).triangles;
  std::vector<std::uint8_t> out(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < faults.size(); ++t)
    if (faults[t] && (before.empty() || !before[t]))
      for (const std::uint32_t v : mesh.triangles[t]) out[v] = 1;
  return out;
}

std::vector<float> fading_around(const MeshNeighbours& neighbours,
                                 const std::vector<std::uint8_t>& marked, int rings) {
  // The value falls by one from each ring to the next.
  std::vector<float> reached(marked.begin(), marked.end()), out = reached;
  for (int ring = 1; ring < rings; ++ring) {
    reached = neighbours.largest(std::move(reached), 1);
    for (std::size_t v = 0; v < out.size(); ++v) out[v] += reached[v];
  }
  for (float& share : out) share /= float(rings);
  return out;
}

Result<> untangle(TriangleMesh& mesh, const std::vector<Vec3f>& start, const RunContext& context) {
  std::vector<std::uint8_t> crossing = crossing_vertices(mesh, {});
  if (!any_marked(crossing)) return {};
  TriangleMesh unmoved;
  unmoved.vertices = start;
  unmoved.triangles = mesh.triangles;
  const std::vector<std::uint8_t> before = self_intersections(unmoved).triangles;
  const MeshNeighbours neighbours(mesh);
  for (std::size_t n = 0; n < kSmallSteps + std::size(kWholeWayRings); ++n) {
    TURNSCAN_TRY(context.check());
    const bool small = n < kSmallSteps;
    const float step = small ? kSmallStep : 1.0f;
    const std::vector<float> share = fading_around(
        neighbours, crossing, small ? kSmallStepRings : kWholeWayRings[n - kSmallSteps]);
    for (std::size_t v = 0; v < share.size(); ++v)
      mesh.vertices[v] += step * share[v] * (start[v] - mesh.vertices[v]);
    crossing = crossing_vertices(mesh, before, triangles_at(mesh, share));
    if (!any_marked(crossing)) return {};
  }
  mesh.vertices = start;
  return {};
}

Result<> smooth_crossings(TriangleMesh& mesh, const std::vector<std::uint8_t>& loose,
                          const RunContext& context) {
  const std::vector<std::uint8_t> moved = triangles_at(mesh, loose);
  std::vector<std::uint8_t> crossing = crossing_vertices(mesh, {}, moved);
  if (!any_marked(crossing)) return {};
  const MeshNeighbours neighbours(mesh);
  const std::vector<Vec3f> start = mesh.vertices;
  for (int rings = 2; rings <= kMostSmoothedRings && any_marked(crossing); ++rings) {
    TURNSCAN_TRY(context.check());
    const std::vector<float> share = fading_around(neighbours, crossing, rings);
    for (int round = 0; round < rings; ++round) {
      std::vector<Vec3f> next = mesh.vertices;
      for (std::size_t v = 0; v < share.size(); ++v)
        if (loose[v] && share[v] > 0.0f)
          next[v] +=
              0.5f * share[v] * (neighbours.mean(mesh.vertices, v, Vec3f(Vec3f::Zero())) - next[v]);
      mesh.vertices.swap(next);
    }
    crossing = crossing_vertices(mesh, {}, moved);
  }
  if (any_marked(crossing)) mesh.vertices = start;
  return {};
}

}  // namespace turnscan::mesh_refinement
