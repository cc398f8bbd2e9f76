#include <turnscan/core/cube_table.hpp>
#include <vector>

namespace turnscan {

namespace {

// The corners of each face, counter-clockwise seen from outside the cube.
constexpr std::array<std::array<int, 4>, 6> kFaces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

int edge_between(int a, int b) {
  const int low = a & b, axis = (a ^ b) >> 1;  // 1, 2, 4 -> 0, 1, 2
  for (int edge = 0; edge < kCubeEdges; ++edge) {
    const CubeEdge e = cube_edge(edge);
    if (e.corner == low && e.axis == axis) return edge;
  }
  return -1;
}

bool has_corner(const std::array<int, 4>& face, int corner) {
  return face[0] == corner || face[1] == corner || face[2] == corner || face[3] == corner;
}

bool share_face(int edge_a, int edge_b) {
  const CubeEdge a = cube_edge(edge_a), b = cube_edge(edge_b);
  for (const auto& face : kFaces) {
    if (has_corner(face, a.corner) && has_corner(face, a.corner | 1 << a.axis) &&
        has_corner(face, b.corner) && has_corner(face, b.corner | 1 << b.axis))
      return true;
  }
  return false;
}

/// For each crossed edge, the next one along the surface's border in the cube, else -1. On each
/// face, every run of inside corners is separated by its own line.
std::array<int, kCubeEdges> successors(unsigned inside) {
  std::array<int, kCubeEdges> next;
  next.fill(-1);
  const auto in = [inside](int corner) { return (inside >> corner & 1) != 0; };
  for (const auto& face : kFaces) {
    for (int i = 0; i < 4; ++i) {
      if (in(face[i]) || !in(face[(i + 1) % 4])) continue;
      int j = (i + 1) % 4;
      while (in(face[(j + 1) % 4])) j = (j + 1) % 4;
      next[edge_between(face[i], face[(i + 1) % 4])] = edge_between(face[j], face[(j + 1) % 4]);
    }
  }
  return next;
}

using Triangles = std::vector<CubeTriangle>;

/// Whether the fan of `loop` around its vertex `apex` has no diagonal on a face of the cube, where
/// the neighbour might have the same diagonal.
bool fan_is_safe(const std::vector<int>& loop, std::size_t apex) {
  const std::size_t n = loop.size();
  for (std::size_t k = 2; k + 1 < n; ++k)
    if (share_face(loop[apex], loop[(apex + k) % n])) return false;
  return true;
}

/// Each of the 256 cases has such a fan for each of its loops (verified by the tests).
void add_loop(const std::vector<int>& loop, Triangles& out) {
  const std::size_t n = loop.size();
  std::size_t apex = 0;
  while (apex + 1 < n && !fan_is_safe(loop, apex)) ++apex;
  for (std::size_t k = 1; k + 1 < n; ++k)
    out.push_back({std::uint8_t(loop[apex]), std::uint8_t(loop[(apex + k) % n]),
                   std::uint8_t(loop[(apex + k + 1) % n])});
}

Triangles triangles_of(unsigned inside) {
  auto next = successors(inside);
  Triangles out;
  for (int first = 0; first < kCubeEdges; ++first) {
    std::vector<int> loop;
    for (int edge = first; next[edge] >= 0;) {
      loop.push_back(edge);
      const int following = next[edge];
      next[edge] = -1;
      edge = following;
    }
    if (!loop.empty()) add_loop(loop, out);
  }
  return out;
}

}  // namespace

CubeEdge cube_edge(int edge) {
  const int axis = edge / 4, k = edge % 4;
  const int low = k & ((1 << axis) - 1), high = (k >> axis) << (axis + 1);
  return {low | high, axis};
}

std::span<const CubeTriangle> cube_triangles(unsigned inside) {
  static const std::vector<Triangles> table = [] {
    std::vector<Triangles> t;
    for (unsigned i = 0; i < 256; ++i) t.push_back(triangles_of(i));
    return t;
  }();
  return table[inside];
}

}  // namespace turnscan
