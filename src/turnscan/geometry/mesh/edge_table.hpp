#pragma once
// Half edges of a triangle mesh, grouped by edge.

#include <array>
#include <cstdint>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh {

using Triangle = std::array<std::uint32_t, 3>;

/// No vertex, half edge or triangle.
inline constexpr std::uint32_t kNone = ~0u;

/// Half edge h = 3 * triangle + corner runs from that corner to the triangle's next corner.
inline std::uint32_t next_in_triangle(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::uint32_t previous_in_triangle(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// The origin vertex of half edge h.
inline std::uint32_t origin(const TriangleMesh& mesh, std::uint32_t h) {
  return mesh.triangles[h / 3][h % 3];
}

/// Half edges grouped by their edge. O(triangles) memory and, for bounded vertex degrees, time.
class EdgeTable {
 public:
  /// Skips triangles for which use[t] == 0 (an empty use: none). The indices of the others must be
  /// in [0, vertex_count). At most 2^30 triangles.
  EdgeTable(std::span<const Triangle> triangles, std::size_t vertex_count,
            std::span<const std::uint8_t> use = {});

  std::size_t edge_count() const { return first_.size() - 1; }
  /// Half edges of one edge, ascending. Edges are in the order of (smaller, larger vertex).
  std::span<const std::uint32_t> half_edges(std::size_t edge) const {
    return std::span(half_edges_).subspan(first_[edge], first_[edge + 1] - first_[edge]);
  }

 private:
  std::vector<std::uint32_t> half_edges_;
  std::vector<std::uint32_t> first_;
};

}  // namespace turnscan::mesh
