#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/simulator/scene/room.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

const Vec3d kCentre(0.1, 0.2, -0.3);
constexpr double kRadius = 0.15;

TriangleMesh room_of(RoomKind kind, const std::vector<Vec3d>& scanners, std::uint64_t seed = 1,
                     int clutter = 40) {
  RoomOptions o;
  o.kind = kind;
  o.clutter = clutter;
  return make_room(o, kCentre, kRadius, 0.02, scanners, seed);
}

Vec3d at_azimuth(double azimuth, double away, double height) {
  return kCentre + Vec3d(-away * std::sin(azimuth), height, -away * std::cos(azimuth));
}

TEST(Room, IsNothingUnlessAskedFor) {
  EXPECT_TRUE(room_of(RoomKind::kNone, {at_azimuth(0, 1, 0.3)}).empty());
}

TEST(Room, StaysBelowThePlatterAndClearOfIt) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh room = room_of(RoomKind::kClutter, {at_azimuth(0.5, 0.9, 0.4)}, seed);
    for (const Vec3f& v : room.vertices) {
      const Vec3d p = v.cast<double>() - kCentre;
      if (p.y() <= -0.0199) continue;
      ASSERT_GT(std::hypot(p.x(), p.z()), 1.05 * kRadius);
    }
  }
}

TEST(Room, LeavesEveryScannersViewOfThePlatterFree) {
  const std::vector<Vec3d> scanners{at_azimuth(0.0, 0.9, 0.3), at_azimuth(2.0, 1.1, 0.05),
                                    at_azimuth(-2.5, 0.7, 0.5)};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh room = room_of(RoomKind::kClutter, scanners, seed);
    const auto scene = Scene::create(std::span(&room, 1));
    ASSERT_TRUE(scene);
    for (const Vec3d& eye : scanners) {
      for (int i = 0; i < 36; ++i) {
        const Vec3d rim = at_azimuth(i * test::kPi / 18.0, kRadius, 0.0);
        Ray ray;
        ray.origin = eye.cast<float>();
        ray.direction = (rim - eye).cast<float>();
        ray.t_max = 1.0f;
        ASSERT_FALSE(scene->occluded(ray));
      }
    }
  }
}

TEST(Room, HasItsWallBehindThePlatterAndBehindEveryScanner) {
  const std::vector<Vec3d> scanners{at_azimuth(0.7, 0.9, 0.3),
                                    at_azimuth(0.7 + test::kPi, 1.4, 0.3)};
  const TriangleMesh room = room_of(RoomKind::kWall, scanners);
  const auto scene = Scene::create(std::span(&room, 1));
  ASSERT_TRUE(scene);
  // Along the first scanner's level line of sight, above everything on the desk.
  Ray ray;
  ray.origin = at_azimuth(0.7, 0.9, 0.5).cast<float>();
  ray.direction =
      (at_azimuth(0.7, 0.0, 0.5) - at_azimuth(0.7, 0.9, 0.5)).normalized().cast<float>();
  const RayHit hit = scene->intersect(ray);
  ASSERT_TRUE(hit.valid());
  EXPECT_GT(hit.t, 0.9 + 1.4);
  const TriangleMesh desk = room_of(RoomKind::kDesk, scanners);
  EXPECT_FALSE(Scene::create(std::span(&desk, 1))->intersect(ray).valid());
}

TEST(Room, IsTheSameForOneSeedAndAnotherForTheNext) {
  const std::vector<Vec3d> scanners{at_azimuth(0, 0.9, 0.3)};
  const auto one = room_of(RoomKind::kClutter, scanners, 1);
  const auto two = room_of(RoomKind::kClutter, scanners, 1);
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_NE(one.vertices, room_of(RoomKind::kClutter, scanners, 2).vertices);
  EXPECT_GT(one.triangles.size(), room_of(RoomKind::kWall, scanners).triangles.size());
}

TEST(Room, HasAColourForEachVertex) {
  const auto room = room_of(RoomKind::kClutter, {at_azimuth(0, 0.9, 0.3)});
  EXPECT_EQ(room.colors.size(), room.vertices.size());
  const auto platter = platter_body(0.1, 0.01);
  EXPECT_EQ(platter.colors.size(), platter.vertices.size());
}

TEST(PlatterBody, ReachesFromTheFaceDownByItsThickness) {
  EXPECT_TRUE(platter_body(0.1, 0.0).empty());
  const Box box = bounds(platter_body(0.1, 0.02).vertices);
  EXPECT_NEAR(box.max.y(), 0.0, 1e-9);
  EXPECT_NEAR(box.min.y(), -0.02, 1e-8);
  EXPECT_NEAR(box.max.x(), 0.1, 1e-6);
}

}  // namespace
}  // namespace turnscan
