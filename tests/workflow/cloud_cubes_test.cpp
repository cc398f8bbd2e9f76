#include <gtest/gtest.h>

#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/workflow/cloud_cubes.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::TempFolder;

/// Centres of cells of 2 mm: a row of three, and one above its end.
PointCloud four_cells() {
  PointCloud cloud;
  cloud.points = {{0.001f, 0.001f, 0.001f},
                  {0.003f, 0.001f, 0.001f},
                  {0.005f, 0.001f, 0.001f},
                  {0.005f, 0.003f, 0.001f}};
  cloud.weights = {1, 5, 9, 2};
  return cloud;
}

TEST(CloudCubes, OfAGridAreItsCellsWithoutFacesBetweenThem) {
  const auto mesh = cubes_of(four_cells(), 0.0, RunContext());
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->triangles.size(), 2u * (4 * 6 - 2 * 3));
  const Box box = bounds(mesh->vertices);
  EXPECT_LT((box.min - Vec3d::Zero()).norm(), 1e-7);
  EXPECT_LT((box.max - Vec3d(0.006, 0.004, 0.002)).norm(), 1e-7);
  EXPECT_EQ(mesh->colors.size(), mesh->vertices.size());
}

TEST(CloudCubes, LookOutwards) {
  const TriangleMesh mesh = *cubes_of(four_cells(), 9.0, RunContext());
  ASSERT_EQ(mesh.triangles.size(), 12u);
  const Vec3f center(0.005f, 0.001f, 0.001f);
  for (const auto& t : mesh.triangles) {
    const Vec3f a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    EXPECT_GT((b - a).cross(c - a).dot(a - center), 0.0f);
  }
}

TEST(CloudCubes, LeaveOutWhatFewPointsAreInAndKeepTheColoursOfTheRest) {
  const TriangleMesh all = *cubes_of(four_cells(), 0.0, RunContext());
  const TriangleMesh some = *cubes_of(four_cells(), 5.0, RunContext());
  EXPECT_EQ(some.triangles.size(), 2u * (2 * 6 - 2));
  EXPECT_EQ(some.colors.back(), all.colors[all.colors.size() - 21]);  // five faces are behind it
  const auto none = cubes_of(four_cells(), 10.0, RunContext());
  EXPECT_EQ(none.error().code, ErrorCode::kTooFewPoints);
}

TEST(CloudCubes, AreEightTimesAsLargeForAViewThatMoves) {
  const PointCloud cloud = four_cells();
  const CloudCubes cubes(cloud);
  EXPECT_TRUE(cubes.on_grid());
  const TriangleMesh mesh = cubes.coarser(0.0);
  EXPECT_EQ(mesh.triangles.size(), 2u * (2 * 6 - 2));  // of three cells, and of the other
  const Box box = bounds(mesh.vertices);
  EXPECT_LT((box.max - Vec3d(0.008, 0.004, 0.004)).norm(), 1e-7);
  EXPECT_EQ(mesh.colors.back(), cubes.mesh(9.0)->colors.back());
  const TriangleMesh one = cubes.coarser(9.0);
  EXPECT_EQ(one.triangles.size(), 12u);
  EXPECT_LT((bounds(one.vertices).size() - Vec3d::Constant(0.004)).norm(), 1e-7);
}

TEST(CloudCubes, OfPointsOnNoGridAreSmallAndWhole) {
  PointCloud cloud = four_cells();
  cloud.weights.clear();
  cloud.points[1].y() += 0.0004f;
  const TriangleMesh mesh = *cubes_of(cloud, 0.0, RunContext());
  EXPECT_EQ(mesh.triangles.size(), 4u * 12);
  EXPECT_TRUE(mesh.colors.empty());
  EXPECT_LT((mesh.vertices[0] - cloud.points[0]).cwiseAbs().maxCoeff(), 0.0014f);
}

TEST(CloudCubes, AreReadFromACloudsFile) {
  const TempFolder folder;
  const auto path = folder / "voxels.ply";
  ASSERT_TRUE(write_cloud(path, four_cells()));
  const auto shown = read_shown(path.string(), 5.0, RunContext());
  ASSERT_TRUE(shown) << shown.error().text();
  EXPECT_EQ(shown->triangles.size(), 20u);
  const auto none = read_shown(path.string(), 100.0, RunContext());
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().text().find("voxels.ply"), std::string::npos);
}

}  // namespace
}  // namespace turnscan
