#include <gtest/gtest.h>

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {
namespace {

TEST(Box, IsEmptyAndOfNoSizeAtFirst) {
  const Box box;
  EXPECT_TRUE(box.empty());
  EXPECT_EQ(box.size(), Vec3d::Zero());
}

TEST(Box, OfOnePointIsThatPoint) {
  Box box;
  box.add({1, 2, 3});
  EXPECT_FALSE(box.empty());
  EXPECT_EQ(box.size(), Vec3d::Zero());
  EXPECT_EQ(box.center(), Vec3d(1, 2, 3));
}

TEST(Bounds, EncloseAllPoints) {
  const Box box = bounds({{1, -2, 3}, {-1, 5, 3}, {0, 0, 0}});
  EXPECT_EQ(box.min, Vec3d(-1, -2, 0));
  EXPECT_EQ(box.max, Vec3d(1, 5, 3));
  EXPECT_EQ(box.size(), Vec3d(2, 7, 3));
  EXPECT_EQ(box.center(), Vec3d(0, 1.5, 1.5));
}

TEST(Bounds, OfNoPointsAreEmpty) { EXPECT_TRUE(bounds({}).empty()); }

TEST(TriangleMesh, IsEmptyWithoutTriangles) {
  TriangleMesh mesh;
  mesh.vertices.assign(3, Vec3f::Zero());
  EXPECT_TRUE(mesh.empty());
  mesh.triangles.push_back({0, 1, 2});
  EXPECT_FALSE(mesh.empty());
}

TEST(PointCloud, IsAsLargeAsItsPoints) {
  PointCloud cloud;
  EXPECT_TRUE(cloud.empty());
  cloud.points.assign(3, Vec3f::Zero());
  EXPECT_EQ(cloud.size(), 3u);
}

}  // namespace
}  // namespace turnscan
