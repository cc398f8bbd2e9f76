#include <turnscan/geometry/search/pseudo_normals.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan {

namespace {

/// An edge from its lower to its higher vertex, with the triangle and the corner it starts at.
struct SidedEdge {
  std::uint32_t low, high, triangle, corner;
};

Vec3d unit_or_zero(const Vec3d& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3d(v / length) : Vec3d::Zero();
}

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

PseudoNormals::PseudoNormals(const TriangleMesh& mesh)
    : vertices_(mesh.vertices),
      triangles_(mesh.triangles),
      of_face_(mesh.triangles.size()),
      of_vertex_(mesh.vertices.size()),
      of_edge_(mesh.triangles.size()) {
  std::vector<Vec3d> sums(vertices_.size(), Vec3d::Zero());
  std::vector<SidedEdge> edges;
  edges.reserve(3 * triangles_.size());
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    const auto& corners = triangles_[t];
    std::array<Vec3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = vertices_[corners[c]].cast<double>();
    const Vec3d normal = unit_or_zero((p[1] - p[0]).cross(p[2] - p[0]));
    of_face_[t] = normal.cast<float>();
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::size_t next = (c + 1) % 3, last = (c + 2) % 3;
      sums[corners[c]] += angle_between(p[next] - p[c], p[last] - p[c]) * normal;
      const auto [low, high] = std::minmax(corners[c], corners[next]);
      edges.push_back({low, high, t, c});
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) of_vertex_[v] = unit_or_zero(sums[v]).cast<float>();
  std::sort(edges.begin(), edges.end(), [](const SidedEdge& a, const SidedEdge& b) {
    return std::tie(a.low, a.high, a.triangle, a.corner) <
           std::tie(b.low, b.high, b.triangle, b.corner);
  });
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    Vec3d sum = Vec3d::Zero();
    for (end = begin; end < edges.size() && edges[end].low == edges[begin].low &&
                      edges[end].high == edges[begin].high;
         ++end)
      sum += of_face_[edges[end].triangle].cast<double>();
    for (std::size_t e = begin; e < end; ++e)
      of_edge_[edges[e].triangle][edges[e].corner] = unit_or_zero(sum).cast<float>();
  }
}

Vec3d PseudoNormals::at(const Vec3d& point, std::uint32_t triangle) const {
  constexpr double kSame_m = 1e-9;
  const auto& corners = triangles_[triangle];
  std::array<Vec3d, 3> p;
  for (std::size_t c = 0; c < 3; ++c) {
    p[c] = vertices_[corners[c]].cast<double>();
    if ((point - p[c]).norm() < kSame_m) return of_vertex_[corners[c]].cast<double>();
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3d& b = p[(c + 1) % 3];
    if ((closest_point_on_triangle(point, p[c], b, b) - point).norm() < kSame_m)
      return of_edge_[triangle][c].cast<double>();
  }
  return of_face_[triangle].cast<double>();
}

}  // namespace turnscan
