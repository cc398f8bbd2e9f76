#include <turnscan/simulator/objects/object_placement.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

const TriangleMesh kBox = test::box_mesh({1.0, 2.0, 3.0}, {2.0, 6.0, 5.0});  // 1 x 4 x 2

PlacedObject placed(const TriangleMesh& mesh, const ObjectPlacement& p) {
  auto object = place_object(mesh, p);
  EXPECT_TRUE(object) << (object ? "" : object.error().text());
  return *object;
}

void expect_box(const TriangleMesh& mesh, const Vec3d& low, const Vec3d& high) {
  const Box box = bounds(mesh.vertices);
  EXPECT_NEAR((box.min - low).norm(), 0.0, 1e-6) << box.min.transpose();
  EXPECT_NEAR((box.max - high).norm(), 0.0, 1e-6) << box.max.transpose();
}

TEST(PlaceObject, SetsItDownOnTheAxis) {
  expect_box(placed(kBox, {}).mesh, {-0.5, 0, -1}, {0.5, 4, 1});
}

TEST(PlaceObject, ScalesItToItsHeight) {
  ObjectPlacement p;
  p.height_m = 0.25;
  const PlacedObject object = placed(kBox, p);
  EXPECT_DOUBLE_EQ(object.scale, 0.0625);
  expect_box(object.mesh, {-0.03125, 0, -0.0625}, {0.03125, 0.25, 0.0625});
}

TEST(PlaceObject, KeepsItsSizeWhenItIsTipped) {
  ObjectPlacement p;
  p.height_m = 0.4;  // then it is 0.1 x 0.4 x 0.2
  p.tip_rad = 0.5 * test::kPi;
  expect_box(placed(kBox, p).mesh, {-0.05, 0, -0.2}, {0.05, 0.2, 0.2});
  p.lean_rad = 0.5 * test::kPi;
  p.tip_rad = 0.0;
  expect_box(placed(kBox, p).mesh, {-0.2, 0, -0.1}, {0.2, 0.1, 0.1});
}

TEST(PlaceObject, TipsItsFrontDownAndLeansItsRightSideUp) {
  ObjectPlacement p;
  p.tip_rad = 0.1;
  EXPECT_LT((placed(kBox, p).T_table_object.linear() * Vec3d::UnitZ()).y(), 0.0);
  p = {};
  p.lean_rad = 0.1;
  EXPECT_GT((placed(kBox, p).T_table_object.linear() * Vec3d::UnitX()).y(), 0.0);
}

TEST(PlaceObject, TurnsAndMovesItOnThePlatter) {
  ObjectPlacement p;
  p.yaw_rad = 0.5 * test::kPi;
  p.x_m = 3.0;
  p.z_m = -4.0;
  expect_box(placed(kBox, p).mesh, {2, 0, -4.5}, {4, 4, -3.5});
}

TEST(PlaceObject, SaysWhereItPutIt) {
  ObjectPlacement p;
  p.height_m = 0.3;
  p.tip_rad = 0.7;
  p.lean_rad = -0.2;
  p.yaw_rad = 1.1;
  p.x_m = 0.02;
  const PlacedObject object = placed(kBox, p);
  for (std::size_t i = 0; i < kBox.vertices.size(); ++i) {
    const Vec3d expected = object.T_table_object * (object.scale * kBox.vertices[i].cast<double>());
    EXPECT_NEAR((object.mesh.vertices[i].cast<double>() - expected).norm(), 0.0, 1e-6);
  }
  EXPECT_NEAR(bounds(object.mesh.vertices).min.y(), 0.0, 1e-7);
}

TEST(PlaceObject, IgnoresVerticesThatNoTriangleNames) {
  TriangleMesh mesh = kBox;
  mesh.vertices.emplace_back(0.0f, -100.0f, 0.0f);
  mesh.vertices.emplace_back(std::nanf(""), 0.0f, 0.0f);
  EXPECT_NEAR(placed(mesh, {}).mesh.vertices[0].y(), 0.0, 1e-6);
}

TEST(PlaceObject, RefusesMeshesThatCannotBePlaced) {
  const auto code = [](const TriangleMesh& mesh, const ObjectPlacement& p) {
    const auto object = place_object(mesh, p);
    return object ? ErrorCode::kCancelled : object.error().code;
  };
  EXPECT_EQ(code(TriangleMesh(), {}), ErrorCode::kTooFewPoints);
  TriangleMesh mesh = kBox;
  mesh.vertices[mesh.triangles[2][1]].y() = std::nanf("");
  EXPECT_EQ(code(mesh, {}), ErrorCode::kFormat);
  mesh = kBox;
  mesh.triangles[0][0] = 1000;
  EXPECT_EQ(code(mesh, {}), ErrorCode::kFormat);
  ObjectPlacement p;
  p.height_m = 0.1;
  EXPECT_EQ(code(test::box_mesh({0, 1, 0}, {1, 1, 1}), p), ErrorCode::kInvalidOption);
  p.height_m = -1.0;
  EXPECT_EQ(code(kBox, p), ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
