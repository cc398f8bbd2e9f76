#include <algorithm>
#include <iterator>
#include <turnscan/geometry/mesh/self_intersections.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_untangle.hpp>

namespace turnscan::mesh_refinement {

namespace {

using Marks = std::vector<std::uint8_t>;

constexpr std::size_t kSmallSteps = 24;
constexpr float kSmallStep = 0.3f;
constexpr int kSmallStepRings = 6;
constexpr int kWholeWayRings[] = {12, 24, 48};
constexpr int kMostSmoothedRings = 24;

/// One flag per vertex: those of triangles that cross others, except triangles that did before
/// (empty: none did). moved: as for self_intersections().
Marks crossing_vertices(const TriangleMesh& mesh, const Marks& before,
                        std::span<const std::uint8_t> moved) {
  const Marks faults = self_intersections(mesh, moved).triangles;
  Marks out(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < faults.size(); ++t)
    if (faults[t] && (before.empty() || !before[t]))
      for (const std::uint32_t v : mesh.triangles[t]) out[v] = 1;
  return out;
}

/// Per vertex: 1 if marked, less by 1 / rings with each ring of neighbours, down to 0.
std::vector<float> fading_around(const MeshNeighbours& neighbours, const Marks& marked, int rings) {
  // The value falls by one from each ring to the next.
  std::vector<float> reached(marked.begin(), marked.end()), out = reached;
  for (int ring = 1; ring < rings; ++ring) {
    reached = neighbours.largest(std::move(reached), 1);
    for (std::size_t v = 0; v < out.size(); ++v) out[v] += reached[v];
  }
  for (float& share : out) share /= float(rings);
  return out;
}

class Untangling {
 public:
  Untangling(TriangleMesh& mesh, const std::vector<Vec3f>& start, const Marks& loose,
             Marks crossing, const RunContext& context)
      : mesh_(mesh),
        start_(start),
        loose_(loose),
        crossing_(std::move(crossing)),
        context_(context),
        neighbours_(mesh) {}

  /// Returns whether nothing crosses any more.
  Result<bool> draw_back() {
    TriangleMesh unmoved;
    unmoved.vertices = start_;
    unmoved.triangles = mesh_.triangles;
    const Marks before = self_intersections(unmoved, triangles_at(unmoved, loose_)).triangles;
    for (std::size_t n = 0; n < kSmallSteps + std::size(kWholeWayRings); ++n) {
      TURNSCAN_TRY(context_.check());
      const bool small = n < kSmallSteps;
      std::vector<float> share = fading_around(
          neighbours_, crossing_, small ? kSmallStepRings : kWholeWayRings[n - kSmallSteps]);
      for (std::size_t v = 0; v < share.size(); ++v)
        if (!loose_[v]) share[v] = 0.0f;
      draw_back(share, small ? kSmallStep : 1.0f);
      crossing_ = crossing_vertices(mesh_, before, triangles_at(mesh_, share));
      if (!any_marked(crossing_)) break;
    }
    if (any_marked(crossing_)) draw_back(std::vector<float>(loose_.begin(), loose_.end()), 1.0f);
    if (any_marked(before)) crossing_ = crossing_vertices(mesh_, {}, triangles_at(mesh_, loose_));
    return !any_marked(crossing_);
  }

  /// Averages loose vertices, or all. Returns whether nothing crosses any more; otherwise nothing
  /// has moved.
  Result<bool> average(bool all) {
    const std::vector<Vec3f> before = mesh_.vertices;
    const Marks from = crossing_;
    for (int rings = 2; rings <= kMostSmoothedRings; ++rings) {
      TURNSCAN_TRY(context_.check());
      const std::vector<float> share = fading_around(neighbours_, crossing_, rings);
      for (int round = 0; round < rings; ++round) {
        std::vector<Vec3f> next = mesh_.vertices;
        for (std::size_t v = 0; v < share.size(); ++v)
          if ((all || loose_[v]) && share[v] > 0.0f)
            next[v] += 0.5f * share[v] *
                       (neighbours_.mean(mesh_.vertices, v, Vec3f(Vec3f::Zero())) - next[v]);
        mesh_.vertices.swap(next);
      }
      crossing_ = crossing_vertices(mesh_, {}, triangles_at(mesh_, share));
      if (!any_marked(crossing_)) return true;
    }
    mesh_.vertices = before;
    crossing_ = from;
    return false;
  }

 private:
  void draw_back(const std::vector<float>& share, float step) {
    for (std::size_t v = 0; v < share.size(); ++v)
      mesh_.vertices[v] += step * share[v] * (start_[v] - mesh_.vertices[v]);
  }

  TriangleMesh& mesh_;
  const std::vector<Vec3f>& start_;
  const Marks& loose_;
  Marks crossing_;
  const RunContext& context_;
  MeshNeighbours neighbours_;
};

}  // namespace

bool any_marked(const std::vector<std::uint8_t>& marks) {
  return std::find(marks.begin(), marks.end(), 1) != marks.end();
}

Result<> untangle(TriangleMesh& mesh, const std::vector<Vec3f>& start,
                  const std::vector<std::uint8_t>& loose, const RunContext& context) {
  const Marks moves = loose.empty() ? Marks(mesh.vertices.size(), 1) : loose;
  Marks crossing = crossing_vertices(mesh, {}, triangles_at(mesh, moves));
  if (!any_marked(crossing)) return {};
  Untangling untangling(mesh, start, moves, std::move(crossing), context);
  TURNSCAN_ASSIGN(bool done, untangling.draw_back());
  for (const bool all : {false, true}) {
    if (done) break;
    TURNSCAN_ASSIGN(done, untangling.average(all));
  }
  return {};
}

}  // namespace turnscan::mesh_refinement
