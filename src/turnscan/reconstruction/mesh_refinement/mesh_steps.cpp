// Vertex adjacency, and steps that do not flip triangles.

#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>

namespace turnscan::mesh_refinement {

namespace {

/// Number of times that steps are halved before they are omitted.
constexpr int kHalvings = 4;

/// Scales the steps of triangles that would rotate by more than allowed. Returns whether there were
/// any.
bool shorten_folding(const TriangleMesh& mesh, std::vector<Vec3f>& step, float to) {
  const auto& p = mesh.vertices;
  std::vector<std::uint8_t> folds(mesh.triangles.size());
  parallel_for(folds.size(), 4096, [&](std::size_t i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3f before = (p[b] - p[a]).cross(p[c] - p[a]);
    const Vec3f pa = p[a] + step[a];
    const Vec3f after = (p[b] + step[b] - pa).cross(p[c] + step[c] - pa);
    folds[i] = before.dot(after) < kMinTurn * before.norm() * after.norm() ? 1 : 0;
  });
  std::vector<std::uint8_t> shorter(p.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < folds.size(); ++i) {
    if (folds[i] == 0) continue;
    any = true;
    for (const std::uint32_t v : mesh.triangles[i]) shorter[v] = 1;
  }
  for (std::size_t v = 0; v < step.size(); ++v) {
    if (shorter[v] != 0) step[v] *= to;
  }
  return any;
}

template <class Choose>
std::vector<float> filtered(const MeshNeighbours& neighbours, std::vector<float> values, int rings,
                            const Choose& choose) {
  for (int ring = 0; ring < rings; ++ring) {
    std::vector<float> out = values;
    parallel_for(values.size(), 4096, [&](std::size_t v) {
      neighbours.each(v, [&](std::uint32_t other) { out[v] = choose(out[v], values[other]); });
    });
    values.swap(out);
  }
  return values;
}

}  // namespace

MeshNeighbours::MeshNeighbours(const TriangleMesh& mesh) : begin(mesh.vertices.size() + 1, 0) {
  // Each edge of a closed mesh is traversed once in each direction.
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) ++begin[v + 1];
  }
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  list.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const auto& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) list[next[t[c]]++] = t[(c + 1) % 3];
  }
}

std::vector<float> MeshNeighbours::least(std::vector<float> values, int rings) const {
  return filtered(*this, std::move(values), rings, [](float a, float b) { return std::min(a, b); });
}

std::vector<float> MeshNeighbours::largest(std::vector<float> values, int rings) const {
  return filtered(*this, std::move(values), rings, [](float a, float b) { return std::max(a, b); });
}

void take_steps(TriangleMesh& mesh, std::vector<Vec3f> step) {
  bool folding = true;
  for (int round = 0; round < kHalvings && folding; ++round)
    folding = shorten_folding(mesh, step, 0.5f);
  // A fixed vertex may fold triangles whose other vertices move: repeat until there are no folds.
  // Each round removes at least one step, and without steps nothing folds.
  while (folding) folding = shorten_folding(mesh, step, 0.0f);
  parallel_for(step.size(), 4096, [&](std::size_t v) { mesh.vertices[v] += step[v]; });
}

}  // namespace turnscan::mesh_refinement
