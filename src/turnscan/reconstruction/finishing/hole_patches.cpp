#include <algorithm>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>
#include <turnscan/reconstruction/finishing/hole_patches.hpp>

namespace turnscan::finishing {

namespace {

/// For each half edge the next one on the same edge, cyclically.
std::vector<std::uint32_t> rings_of(const TriangleMesh& mesh) {
  const mesh::EdgeTable edges(mesh.triangles, mesh.vertices.size());
  std::vector<std::uint32_t> next(3 * mesh.triangles.size());
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto on_edge = edges.half_edges(e);
    for (std::size_t i = 0; i < on_edge.size(); ++i)
      next[on_edge[i]] = on_edge[(i + 1) % on_edge.size()];
  }
  return next;
}

}  // namespace

std::vector<HolePatch> find_hole_patches(const TriangleMesh& mesh,
                                         const std::vector<Evidence>& evidence) {
  const std::vector<std::uint32_t> next = rings_of(mesh);
  std::vector<std::uint8_t> taken(mesh.triangles.size(), 0);
  std::vector<HolePatch> patches;
  for (std::uint32_t first = 0; first < taken.size(); ++first) {
    if (taken[first] || evidence[first] == Evidence::kMeasured) continue;
    HolePatch patch;
    patch.triangles.push_back(first);
    taken[first] = 1;
    Box box;
    for (std::size_t i = 0; i < patch.triangles.size(); ++i) {
      const std::uint32_t t = patch.triangles[i];
      patch.area_m2 += triangle_area(mesh, t);
      for (std::uint32_t corner = 0; corner < 3; ++corner) {
        box.add(mesh.vertices[mesh.triangles[t][corner]].cast<double>());
        const std::uint32_t h = 3 * t + corner;
        for (std::uint32_t other = next[h]; other != h; other = next[other]) {
          if (taken[other / 3] || evidence[other / 3] == Evidence::kMeasured) continue;
          taken[other / 3] = 1;
          patch.triangles.push_back(other / 3);
        }
      }
    }
    std::sort(patch.triangles.begin(), patch.triangles.end());
    patch.size_m = box.size().maxCoeff();
    patches.push_back(std::move(patch));
  }
  return patches;
}

}  // namespace turnscan::finishing
