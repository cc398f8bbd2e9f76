#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/hull/alpha_shape.hpp>
#include <turnscan/geometry/mesh/mesh_measure.hpp>

namespace turnscan {
namespace {

std::vector<Vec3f> random_points(std::uint64_t seed, std::uint32_t n) {
  std::vector<Vec3f> points;
  for (std::uint64_t i = 0; i < n; ++i)
    points.emplace_back(float(uniform01(hash_key(seed, i, 0))),
                        float(uniform01(hash_key(seed, i, 1))),
                        float(uniform01(hash_key(seed, i, 2))));
  return points;
}

bool holds_none(const std::vector<Vec3f>& points, const Vec3d& centre, double radius) {
  return std::none_of(points.begin(), points.end(), [&](const Vec3f& p) {
    return (p.cast<double>() - centre).norm() < radius * (1.0 - 1e-9);
  });
}

/// Every four points whose circumsphere is empty.
std::vector<Tetrahedron> delaunay_of(const std::vector<Vec3f>& points) {
  std::vector<Tetrahedron> out;
  const auto n = std::uint32_t(points.size());
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      for (std::uint32_t c = b + 1; c < n; ++c)
        for (std::uint32_t d = c + 1; d < n; ++d) {
          Eigen::Matrix3d sides;
          Vec3d half;
          const Vec3d o = points[a].cast<double>();
          int row = 0;
          for (const std::uint32_t i : {b, c, d}) {
            sides.row(row) = points[i].cast<double>() - o;
            half[row] = 0.5 * sides.row(row).squaredNorm();
            ++row;
          }
          const Vec3d centre = sides.inverse() * half;
          if (holds_none(points, o + centre, centre.norm())) out.push_back({a, b, c, d});
        }
  return out;
}

/// The definition: a triangle is exposed where a ball of radius alpha that holds no point has its
/// corners on its border.
std::set<std::set<std::uint32_t>> exposed_triangles(const std::vector<Vec3f>& points,
                                                    double alpha) {
  std::set<std::set<std::uint32_t>> out;
  const auto n = std::uint32_t(points.size());
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = i + 1; j < n; ++j)
      for (std::uint32_t k = j + 1; k < n; ++k) {
        const Vec3d o = points[i].cast<double>(), a = points[j].cast<double>() - o,
                    b = points[k].cast<double>() - o, normal = a.cross(b);
        const Vec3d centre =
            (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) /
            (2.0 * normal.squaredNorm());
        const double height = std::sqrt(alpha * alpha - centre.squaredNorm());
        if (!(height >= 0.0)) continue;
        const Vec3d up = height * normal.normalized();
        if (holds_none(points, o + centre + up, alpha) ||
            holds_none(points, o + centre - up, alpha))
          out.insert({i, j, k});
      }
  return out;
}

/// The mesh's triangles by the positions of their corners in the points.
std::set<std::set<std::uint32_t>> triangles_of(const TriangleMesh& mesh,
                                               const std::vector<Vec3f>& points) {
  std::set<std::set<std::uint32_t>> out;
  for (const auto& t : mesh.triangles) {
    std::set<std::uint32_t> corners;
    for (const std::uint32_t corner : t)
      corners.insert(std::uint32_t(std::find(points.begin(), points.end(), mesh.vertices[corner]) -
                                   points.begin()));
    out.insert(corners);
  }
  return out;
}

TEST(AlphaShape, HasTheTrianglesThatEmptyBallsTouch) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const std::vector<Vec3f> points = random_points(seed, 14);
    const std::vector<Tetrahedron> delaunay = delaunay_of(points);
    for (const double alpha : {0.15, 0.22, 0.3, 0.4, 0.6, 1.5}) {
      const TriangleMesh shape = alpha_shape(points, delaunay, alpha);
      EXPECT_EQ(triangles_of(shape, points), exposed_triangles(points, alpha))
          << "seed " << seed << ", alpha " << alpha;
      EXPECT_EQ(triangles_of(shape, points).size(), shape.triangles.size());
    }
  }
}

TEST(AlphaShape, OfALargeAlphaIsTheConvexHullFacingOutward) {
  const std::vector<Vec3f> points = random_points(7, 14);
  const std::vector<Tetrahedron> delaunay = delaunay_of(points);
  double volume = 0.0;
  for (const Tetrahedron& t : delaunay) {
    const auto at = [&](unsigned k) { return points[t[k]].cast<double>(); };
    volume += std::abs((at(1) - at(0)).dot((at(2) - at(0)).cross(at(3) - at(0)))) / 6.0;
  }
  EXPECT_NEAR(signed_volume(alpha_shape(points, delaunay, 1e6)), volume, 1e-6 * volume);
}

TEST(AlphaShape, OfATinyAlphaIsEmpty) {
  const std::vector<Vec3f> points = random_points(7, 14);
  EXPECT_TRUE(alpha_shape(points, delaunay_of(points), 1e-4).empty());
}

}  // namespace
}  // namespace turnscan
