// Treatment of unmeasured vertices, and of those where only the platter was measured.

#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>

namespace turnscan::mesh_refinement {

void fair(TriangleMesh& mesh, const MeshNeighbours& neighbours, const std::vector<float>& support,
          const MeshFitScale& scale) {
  constexpr int kRounds = 80;
  auto& p = mesh.vertices;
  const float reach = float(scale.fair_m);
  const std::vector<float> hold = measured_shares(support);
  std::vector<std::uint32_t> loose;
  for (std::uint32_t v = 0; v < p.size(); ++v) {
    if (hold[v] < 1.0f && !below_floor(p[v], scale)) loose.push_back(v);
  }
  const std::vector<Vec3f> start = p;
  std::vector<Vec3f> next(loose.size());
  for (int round = 0; round < kRounds; ++round) {
    parallel_for(loose.size(), 4096, [&](std::size_t k) {
      const std::uint32_t v = loose[k];
      const Vec3f mean = neighbours.mean(p, v, Vec3f(Vec3f::Zero()));
      const Vec3f to = p[v] + 0.5f * (1.0f - hold[v]) * (mean - p[v]) - start[v];
      next[k] = start[v] + to * std::min(1.0f, reach / std::max(to.norm(), 1e-9f));
    });
    for (std::size_t k = 0; k < loose.size(); ++k) p[loose[k]] = next[k];
  }
}

void straighten_walls(TriangleMesh& mesh, const MeshNeighbours& neighbours,
                      const std::vector<float>& support, const MeshFitScale& scale) {
  constexpr int kRounds = 20;
  const std::vector<float> hold = measured_shares(support);
  const auto& p = mesh.vertices;
  // On the base but not at its outline.
  std::vector<std::uint8_t> inner(p.size(), 0);
  std::vector<std::uint32_t> standing;
  const auto lowest = [&](std::uint32_t v) { return std::abs(p[v].y()) < 1e-6f; };
  for (std::uint32_t v = 0; v < p.size(); ++v) {
    if (!below_floor(p[v], scale)) continue;
    standing.push_back(v);
    bool all = lowest(v);
    neighbours.each(v, [&](std::uint32_t u) { all &= lowest(u); });
    inner[v] = all ? 1 : 0;
  }
  std::vector<Vec3f> to = p, next(standing.size());
  for (int round = 0; round < kRounds; ++round) {
    parallel_for(standing.size(), 4096, [&](std::size_t k) {
      const std::uint32_t v = standing[k];
      Vec3f sum = Vec3f::Zero();
      float count = 0.0f;
      neighbours.each(v, [&](std::uint32_t u) {
        if (inner[u] && !inner[v]) return;
        sum += to[u];
        count += 1.0f;
      });
      const float loose = 0.5f * (1.0f - hold[v]);
      next[k] = count > 0.0f ? Vec3f(to[v] + loose * (sum / count - to[v])) : to[v];
      next[k].y() = p[v].y();
    });
    for (std::size_t k = 0; k < standing.size(); ++k) to[standing[k]] = next[k];
  }
  std::vector<Vec3f> step(p.size(), Vec3f::Zero());
  const auto limit = float(scale.fair_m > 0.0 ? scale.fair_m : scale.limit_m);
  for (const std::uint32_t v : standing) {
    step[v] = to[v] - p[v];
    step[v] *= std::min(1.0f, limit / std::max(step[v].norm(), 1e-9f));
  }
  take_steps(mesh, std::move(step));
}

}  // namespace turnscan::mesh_refinement
