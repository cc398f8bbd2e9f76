#include <turnscan/geometry/search/pseudo_normals.hpp>

#include <algorithm>
#include <cmath>
#include <compare>
#include <span>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan {

namespace {

/// An edge by its higher vertex, with the triangle and the corner at which it starts.
struct SidedEdge {
  std::uint32_t high, triangle, corner;
  auto operator<=>(const SidedEdge&) const = default;
};

Vec3d unit_or_zero(const Vec3d& v) {
  const double length = v.norm();
  return length > 0.0 ? Vec3d(v / length) : Vec3d::Zero();
}

double angle_between(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

PseudoNormals::PseudoNormals(const TriangleMesh& mesh) : PseudoNormals(mesh, RunContext()) {}

Result<PseudoNormals> PseudoNormals::create(const TriangleMesh& mesh, const RunContext& context) {
  PseudoNormals normals(mesh, context);
  TURNSCAN_TRY(context.check());
  return normals;
}

/// Useless once the context is cancelled, as is set_edges().
PseudoNormals::PseudoNormals(const TriangleMesh& mesh, const RunContext& context)
    : vertices_(mesh.vertices),
      triangles_(mesh.triangles),
      of_face_(mesh.triangles.size()),
      of_vertex_(mesh.vertices.size()),
      of_edge_(mesh.triangles.size()) {
  std::vector<std::array<double, 3>> angles(triangles_.size());
  (void)parallel_for(triangles_.size(), 4096, context, [&](std::size_t t) {
    std::array<Vec3d, 3> p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = vertices_[triangles_[t][c]].cast<double>();
    of_face_[t] = unit_or_zero((p[1] - p[0]).cross(p[2] - p[0])).cast<float>();
    for (std::size_t c = 0; c < 3; ++c)
      angles[t][c] = angle_between(p[(c + 1) % 3] - p[c], p[(c + 2) % 3] - p[c]);
  });
  if (context.cancelled()) return;
  std::vector<Vec3d> sums(vertices_.size(), Vec3d::Zero());
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      sums[triangles_[t][c]] += angles[t][c] * of_face_[t].cast<double>();
  (void)parallel_for(sums.size(), 4096, context,
                     [&](std::size_t v) { of_vertex_[v] = unit_or_zero(sums[v]).cast<float>(); });
  if (!context.cancelled()) set_edges(context);
}

void PseudoNormals::set_edges(const RunContext& context) {
  // Bucketed by their lower vertex, so that only those of one vertex remain to be sorted.
  std::vector<std::uint32_t> end(vertices_.size() + 1, 0);
  const auto for_each_edge = [&](const auto& take) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (std::uint32_t c = 0; c < 3; ++c) {
        const auto [low, high] = std::minmax(triangles_[t][c], triangles_[t][(c + 1) % 3]);
        take(low, SidedEdge{high, t, c});
      }
  };
  for_each_edge([&](std::uint32_t low, const SidedEdge&) { ++end[low + 1]; });
  for (std::size_t v = 0; v + 1 < end.size(); ++v) end[v + 1] += end[v];
  std::vector<SidedEdge> edges(3 * triangles_.size());
  for_each_edge([&](std::uint32_t low, const SidedEdge& edge) { edges[end[low]++] = edge; });
  (void)parallel_for(vertices_.size(), 4096, context, [&](std::size_t v) {
    const auto of_vertex =
        std::span(edges).subspan(v > 0 ? end[v - 1] : 0).first(end[v] - (v > 0 ? end[v - 1] : 0));
    std::sort(of_vertex.begin(), of_vertex.end());
    for (auto first = of_vertex.begin(); first != of_vertex.end();) {
      Vec3d sum = Vec3d::Zero();
      auto next = first;
      for (; next != of_vertex.end() && next->high == first->high; ++next)
        sum += of_face_[next->triangle].cast<double>();
      for (; first != next; ++first)
        of_edge_[first->triangle][first->corner] = unit_or_zero(sum).cast<float>();
    }
  });
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
