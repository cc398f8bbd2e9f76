#include <turnscan/geometry/mesh/edge_table.hpp>
#include <turnscan/geometry/mesh/vertex_neighbours.hpp>

namespace turnscan::mesh {

VertexNeighbours::VertexNeighbours(const TriangleMesh& mesh) : start_(mesh.vertices.size() + 1, 0) {
  const EdgeTable edges(mesh.triangles, mesh.vertices.size());
  const auto ends = [&](std::size_t e) {
    const std::uint32_t h = edges.half_edges(e)[0];
    const std::uint32_t g = next_in_triangle(h);
    return std::pair(mesh.triangles[h / 3][h % 3], mesh.triangles[g / 3][g % 3]);
  };
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto [a, b] = ends(e);
    if (a == b) continue;
    ++start_[a + 1];
    ++start_[b + 1];
  }
  for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
  neighbours_.resize(start_.back());
  std::vector<std::size_t> cursor(start_.begin(), start_.end() - 1);
  for (std::size_t e = 0; e < edges.edge_count(); ++e) {
    const auto [a, b] = ends(e);
    if (a == b) continue;
    neighbours_[cursor[a]++] = b;
    neighbours_[cursor[b]++] = a;
  }
}

}  // namespace turnscan::mesh
