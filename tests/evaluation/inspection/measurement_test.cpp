#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <turnscan/evaluation/inspection/measurement.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

Vec3d random_point(std::uint64_t i, std::uint64_t j) {
  return 0.1 * Vec3d(random_value(i, j, 0), random_value(i, j, 1), random_value(i, j, 2));
}

TEST(Measure, DistancesAnglesAndCirclesOfKnownPlaces) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Vec3d center = random_point(1, i), u = random_point(2, i).normalized();
    const Vec3d v = u.unitOrthogonal();
    const double r = 0.01 + 0.001 * double(i), turn = 0.1 + 0.05 * double(i % 50);
    const auto on = [&](double a) {
      return Vec3d(center + r * (std::cos(a) * u + std::sin(a) * v));
    };
    const auto circle = measure(MeasurementKind::kCircle, {on(0.2), on(1.7), on(4.0)}, {});
    ASSERT_TRUE(circle);
    EXPECT_NEAR(circle->value, 2.0 * r, 1e-9);
    EXPECT_LT((circle->circle.center - center).norm(), 1e-9);
    const auto angle = measure(MeasurementKind::kAngle, {on(0.0), center, on(turn)}, {});
    ASSERT_TRUE(angle);
    EXPECT_NEAR(angle->value, turn, 1e-9);
    const auto distance = measure(MeasurementKind::kDistance, {on(0.0), on(std::numbers::pi)}, {});
    ASSERT_TRUE(distance);
    EXPECT_NEAR(distance->value, 2.0 * r, 1e-12);
  }
}

TEST(Measure, RefusesPlacesThatDetermineNothing) {
  const Vec3d p(0.01, 0.02, 0.03);
  EXPECT_FALSE(measure(MeasurementKind::kAngle, {p, p, Vec3d::Zero()}, {}));
  EXPECT_FALSE(measure(MeasurementKind::kCircle, {Vec3d::Zero(), p, 2.0 * p}, {}));
  EXPECT_FALSE(measure(MeasurementKind::kPlane, {p}, {nullptr, {}, 0.01}));
  const auto thickness = measure(MeasurementKind::kThickness, {p}, {});
  ASSERT_FALSE(thickness);
  EXPECT_EQ(thickness.error().code, ErrorCode::kUnsupported);
  EXPECT_THROW((void)measure(MeasurementKind::kDistance, {p}, {}), std::invalid_argument);
  EXPECT_THROW((void)measure(MeasurementKind::kDeviation, {p}, {}), std::invalid_argument);
}

TEST(Measure, APlaneOfOneSideOfAThinWallAlone) {
  TriangleMesh wall = plane(40, 0.04, 0.0005);
  TriangleMesh back = plane(40, 0.04, 0.0);
  flip(back);
  append(wall, back);
  const auto made =
      measure(MeasurementKind::kPlane, {Vec3d(0.02, 0.02, 0.0006)}, {&wall, wall.vertices, 0.01});
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_LT(made->value, 1e-7);
  EXPECT_NEAR(made->plane.point.z(), 0.0005, 1e-8);
  EXPECT_NEAR(std::abs(made->plane.normal.z()), 1.0, 1e-9);
  EXPECT_NEAR(double(made->plane.count), std::numbers::pi * 100, 20);  // vertices 1 mm apart
  // A cloud has no sides.
  const auto cloud =
      measure(MeasurementKind::kPlane, {Vec3d(0.02, 0.02, 0.0006)}, {nullptr, wall.vertices, 0.01});
  ASSERT_TRUE(cloud);
  EXPECT_NEAR(cloud->value, 0.0005, 1e-6);
}

TEST(Measure, APlaneOfATriangleLargerThanThePatch) {
  const TriangleMesh box = cube();
  const auto made =
      measure(MeasurementKind::kPlane, {Vec3d(0.4, 1.0, 0.6)}, {&box, box.vertices, 0.01});
  ASSERT_TRUE(made);
  EXPECT_EQ(made->plane.count, 3u);
  EXPECT_NEAR(std::abs(made->plane.normal.y()), 1.0, 1e-9);
}

TEST(Measure, TheThicknessOfABallIsItsDiameter) {
  const TriangleMesh ball = sphere(0.03, 5);
  for (std::uint64_t i = 0; i < 10; ++i) {
    const Vec3d way = random_point(3, i).normalized();
    const auto made = measure(MeasurementKind::kThickness, {0.03 * way}, {&ball, {}, 0.005});
    ASSERT_TRUE(made);
    EXPECT_NEAR(made->value, 0.06, 2e-4);
    ASSERT_EQ(made->places.size(), 2u);
    EXPECT_NEAR((made->places[1] - made->places[0]).norm(), made->value, 1e-9);
  }
}

std::size_t commas_outside_quotes(std::string_view line) {
  std::size_t count = 0;
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    count += c == ',' && !quoted ? 1 : 0;
  }
  return count;
}

TEST(MeasurementsCsv, HasALineOfThirteenCellsForEachKind) {
  const TriangleMesh ball = sphere(0.03, 3);
  const MeasuredSurface surface{&ball, ball.vertices, 0.01};
  std::vector<Measurement> all;
  for (const MeasurementKind kind : kMeasurementKinds) {
    std::vector<Vec3d> places{{0.03, 0, 0}, {0, 0.03, 0}, {0, 0, 0.03}};
    places.resize(places_of(kind));
    Measurement m;
    m.places = places;
    if (kind != MeasurementKind::kDeviation) m = *measure(kind, places, surface);
    m.kind = kind;
    m.of = "a \"bear\", 2";
    EXPECT_FALSE(measurement_text(m).empty());
    all.push_back(m);
  }
  const std::string text = measurements_csv(all);
  std::size_t lines = 0;
  for (std::size_t at = 0; at < text.size(); ++lines) {
    const std::size_t end = text.find('\n', at);
    EXPECT_EQ(commas_outside_quotes(std::string_view(text).substr(at, end - at)), 12u);
    at = end + 1;
  }
  EXPECT_EQ(lines, 1 + all.size());
  EXPECT_NE(text.find("2,distance,\"a \"\"bear\"\", 2\",42.42641,mm,,30.0000,0.0000,0.0000"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("3,angle,\"a \"\"bear\"\", 2\",60.00000,deg"), std::string::npos) << text;
}

}  // namespace
}  // namespace turnscan
