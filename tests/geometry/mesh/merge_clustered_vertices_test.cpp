#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/core/random.hpp>
#include <turnscan/geometry/mesh/merge_clustered_vertices.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>

#include "tests/geometry/dense_grid.hpp"

namespace turnscan {
namespace {

constexpr int kSide = 24;

template <class Value>
TriangleMesh marched(const Value& value) {
  DenseGrid grid{Vec3d(-1, -1, -1), 2.0 / (kSide - 1), {kSide, kSide, kSide}, {}};
  for (int k = 0; k < kSide; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i)
        grid.values.push_back(float(value(grid.origin_m + grid.cell_m * Vec3d(i, j, k), i, j, k)));
    }
  }
  return *isosurface(grid, {}, RunContext());
}

ClusterScale scale_of_grid() {
  ClusterScale scale;
  scale.origin_m = Vec3d(-1, -1, -1);
  scale.cell_m = 2.0 / (kSide - 1);
  return scale;
}

double ball(const Vec3d& p, int, int, int) { return p.norm() - 0.7; }

/// Least angle of a triangle, in degrees, at the worst hundredth.
double small_angle(const TriangleMesh& mesh) {
  std::vector<double> angles;
  for (const auto& t : mesh.triangles) {
    double least = 180.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3f a = mesh.vertices[t[(c + 1) % 3]] - mesh.vertices[t[c]];
      const Vec3f b = mesh.vertices[t[(c + 2) % 3]] - mesh.vertices[t[c]];
      least = std::min(least, std::atan2(double(a.cross(b).norm()), double(a.dot(b))) * 57.2958);
    }
    angles.push_back(least);
  }
  std::sort(angles.begin(), angles.end());
  return angles[angles.size() / 100];
}

TEST(EvenOut, LeavesAboutAQuarterOfTheTrianglesAndNoSlivers) {
  const TriangleMesh mesh = marched(ball);
  const auto out = merge_clustered_vertices(mesh, scale_of_grid(), RunContext());
  ASSERT_TRUE(out) << out.error().text();
  EXPECT_TRUE(check_mesh(*out).watertight()) << check_mesh(*out).text();
  EXPECT_LT(out->triangles.size(), mesh.triangles.size() * 35 / 100);
  EXPECT_GT(small_angle(*out), 3.0 * small_angle(mesh));
  EXPECT_NEAR(check_mesh(*out).volume_m3, check_mesh(mesh).volume_m3,
              0.02 * check_mesh(mesh).volume_m3);
}

TEST(EvenOut, ClosedAndManifoldHoweverTheSurfaceTwists) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const double share = 0.2 + 0.6 * uniform01(hash_key(seed, 1, 2));
    const TriangleMesh mesh = marched([&](const Vec3d&, int i, int j, int k) {
      const auto at = std::uint64_t(i + kSide * (j + kSide * k));
      return uniform01(hash_key(seed, at, 0)) - share;
    });
    const MeshReport before = check_mesh(mesh);
    const auto out = merge_clustered_vertices(mesh, scale_of_grid(), RunContext());
    ASSERT_TRUE(out) << out.error().text();
    const MeshReport after = check_mesh(*out);
    EXPECT_TRUE(after.closed && after.manifold && after.oriented) << seed << after.text();
    EXPECT_EQ(after.components, before.components);
    EXPECT_LT(out->triangles.size(), mesh.triangles.size());
  }
}

TEST(EvenOut, AFlatBaseStaysFlat) {
  ClusterScale scale = scale_of_grid();
  const float base = -0.4347827f;
  TriangleMesh mesh = marched([&](const Vec3d& p, int, int, int) {
    return std::max(p.norm() - 0.7, double(base) - p.y());
  });
  for (Vec3f& v : mesh.vertices) {
    if (std::abs(v.y() - base) < 1e-5f) v.y() = base;
  }
  scale.flat_m = base;
  const auto area = [&](const TriangleMesh& m) {
    double sum = 0.0;
    for (const auto& t : m.triangles) {
      if (m.vertices[t[0]].y() != base || m.vertices[t[1]].y() != base ||
          m.vertices[t[2]].y() != base)
        continue;
      sum += 0.5 * double((m.vertices[t[1]] - m.vertices[t[0]])
                              .cross(m.vertices[t[2]] - m.vertices[t[0]])
                              .norm());
    }
    return sum;
  };
  const auto out = merge_clustered_vertices(mesh, scale, RunContext());
  ASSERT_TRUE(out);
  EXPECT_GT(area(mesh), 0.5);
  EXPECT_GT(area(*out), 0.95 * area(mesh));
}

TEST(EvenOut, RefusesWhatIsNoMeshAndStopsWhenTold) {
  TriangleMesh broken = marched(ball);
  broken.triangles[0][0] = std::uint32_t(broken.vertices.size());
  EXPECT_EQ(merge_clustered_vertices(broken, scale_of_grid(), RunContext()).error().code,
            ErrorCode::kFormat);
  RunContext cancelled;
  cancelled.cancel();
  EXPECT_EQ(merge_clustered_vertices(marched(ball), scale_of_grid(), cancelled).error().code,
            ErrorCode::kCancelled);
  ClusterScale scale;
  scale.cell_m = 0.0;
  EXPECT_THROW((void)merge_clustered_vertices(marched(ball), scale, RunContext()),
               std::invalid_argument);
  EXPECT_TRUE(merge_clustered_vertices(TriangleMesh(), scale_of_grid(), RunContext())->empty());
}

}  // namespace
}  // namespace turnscan
