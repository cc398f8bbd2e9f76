#include <gtest/gtest.h>

#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/sample.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

/// Two squares of areas 1 and 9, and a triangle without area.
TriangleMesh two_squares() {
  TriangleMesh mesh = plane(1);
  append(mesh, plane(2, 3.0, 5.0));
  mesh.triangles.push_back({0, 0, 1});
  return mesh;
}

TEST(Sample, DensityIsTheSameEverywhere) {
  const auto samples = sample_surface(two_squares(), 10000, 1);
  ASSERT_TRUE(samples);
  EXPECT_DOUBLE_EQ(samples->area_m2, 10.0);
  std::size_t small = 0, right_half = 0;
  for (const Vec3f& p : samples->points) {
    small += p.z() == 0.0f;
    right_half += p.z() == 5.0f && p.x() > 1.5f;
  }
  EXPECT_NEAR(double(small), 1000.0, 1.0) << "stratified to one sample";
  EXPECT_NEAR(double(right_half), 4500.0, 3.0) << "whole triangles are";
}

TEST(Sample, PointsAreUniformWithinATriangle) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  const auto samples = sample_surface(mesh, 40000, 3);
  ASSERT_TRUE(samples);
  Vec3d mean = Vec3d::Zero();
  std::size_t corner = 0;
  for (const Vec3f& p : samples->points) {
    mean += p.cast<double>() / 40000.0;
    corner += p.x() + p.y() < 0.5f;
  }
  EXPECT_NEAR(mean.x(), 1.0 / 3.0, 0.005);
  EXPECT_NEAR(mean.y(), 1.0 / 3.0, 0.005);
  EXPECT_NEAR(double(corner), 10000.0, 400.0) << "a corner of a quarter of the area";
}

TEST(Sample, PointsLieOnTheirTrianglesWithTheirNormals) {
  const TriangleMesh mesh = sphere(2.0, 3);
  const auto samples = sample_surface(mesh, 500, 7);
  ASSERT_TRUE(samples);
  for (std::size_t i = 0; i < samples->size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[samples->triangles[i]];
    const Vec3d p = samples->points[i].cast<double>();
    const Vec3d q =
        closest_point_on_triangle(p, mesh.vertices[a].cast<double>(),
                                  mesh.vertices[b].cast<double>(), mesh.vertices[c].cast<double>());
    ASSERT_LT((p - q).norm(), 1e-6);
    ASSERT_NEAR(samples->normals[i].norm(), 1.0f, 1e-6f);
    ASSERT_GT(samples->normals[i].dot(samples->points[i].normalized()), 0.9f);
  }
}

TEST(Sample, IsTheSameForOneAndTwoThreads) {
  const TriangleMesh mesh = torus(1.0, 0.3, 40, 20);
  set_thread_count(1);
  const auto one = sample_surface(mesh, 50000, 5);
  set_thread_count(2);
  const auto two = sample_surface(mesh, 50000, 5);
  set_thread_count(0);
  ASSERT_TRUE(one && two);
  EXPECT_EQ(one->points, two->points);
  EXPECT_EQ(one->triangles, two->triangles);
  EXPECT_NE(one->points, sample_surface(mesh, 50000, 6)->points) << "another seed";
}

TEST(Sample, FailsWithoutAreaOrWithABrokenMeshOrWhenCancelled) {
  TriangleMesh mesh;
  EXPECT_EQ(sample_surface(mesh, 10, 1).error().code, ErrorCode::kTooFewPoints);
  mesh = cube();
  mesh.triangles[0][0] = 99;
  EXPECT_EQ(sample_surface(mesh, 10, 1).error().code, ErrorCode::kFormat);
  mesh = cube();
  mesh.vertices[3].z() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(sample_surface(mesh, 10, 1).error().code, ErrorCode::kFormat);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(sample_surface(cube(), 10, 1, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
