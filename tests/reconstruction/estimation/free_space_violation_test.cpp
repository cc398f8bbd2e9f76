#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tests/reconstruction/retreating_outlines.hpp>
#include <turnscan/reconstruction/estimation/free_space_violation.hpp>
#include <turnscan/reconstruction/tsdf/measured_points.hpp>

namespace turnscan::estimation {
namespace {

using namespace turnscan::testing;

constexpr double kNoise_m = 0.0005, kPixel_m = 0.0023;

double seen_past(const MemorySequence& sequence) {
  const std::vector<views::DepthView> views = views_of(sequence);
  std::vector<Vec3f> points;
  for (const views::DepthView& view : views)
    tsdf::for_each_point(view, std::nullopt, [&](const Vec3f& p) {
      if (p.y() > 0.005f) points.push_back(p);
    });
  return free_space_violation(views, points, kNoise_m, kPixel_m);
}

TEST(SeenPast, IsNothingOfWhatAllViewsShowAlike) {
  EXPECT_EQ(seen_past(scan(carton, {36, kNoise_m})), 0.0);
  EXPECT_EQ(seen_past(scan(ball, {36, kNoise_m})), 0.0);
}

TEST(SeenPast, IsNothingOfThinPartsAndFlyingPixels) {
  const auto legs = [](const Vec3d& o, const Vec3d& d) {
    double t = to_box(o, d, Vec3d(-0.04, 0.06, -0.03), Vec3d(0.04, 0.07, 0.03));
    for (const double x : {-0.035, 0.03})
      for (const double z : {-0.028, 0.023})
        t = nearer(to_box(o, d, Vec3d(x, 0.0, z), Vec3d(x + 0.005, 0.06, z + 0.005)), t);
    return t;
  };
  EXPECT_EQ(seen_past(scan(legs, {36, kNoise_m})), 0.0);
  EXPECT_EQ(seen_past(scan(legs, {36, kNoise_m, 0.5})), 0.0);
}

/// A level plate beside the table, 30 mm above the platter, in front of what a camera that stands
/// still sees.
MemorySequence with_plate_beside(MemorySequence sequence) {
  const views::DepthView first = views_of(sequence).front();
  const SensorInfo& sensor = sequence.header_value.sensors.front();
  const CameraIntrinsics& camera = sensor.intrinsics;
  const Vec3d up = (first.rotation * Vec3f::UnitY()).cast<double>();
  const double height_m = 0.03 + up.dot(first.translation.cast<double>());
  for (Frame& frame : sequence.data)
    for (int y = 50; y < 62; ++y)
      for (int x = 100; x < 120; ++x) {
        const Vec3d ray((x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0);
        frame.depth.at(x, y) =
            std::uint16_t((height_m / up.dot(ray) - sensor.depth_bias_m) / sensor.depth_unit_m);
      }
  return sequence;
}

TEST(SeenPast, IsNothingOfWhatDoesNotTurn) {
  EXPECT_EQ(seen_past(with_plate_beside(scan(carton, {72, kNoise_m}))), 0.0);
}

TEST(SeenPast, GrowsWithHowFarSomeViewsOutlinesRetreat) {
  const MemorySequence sharp = scan(carton, {36, kNoise_m});
  const double by4 = seen_past(with_retreating_outlines(sharp, 4)),
               by6 = seen_past(with_retreating_outlines(sharp, 6));
  EXPECT_GT(by4, 0.5 * kPixel_m);
  EXPECT_GT(by6, by4);
  EXPECT_LE(by6, 6.0 * kPixel_m);
}

TEST(SeenPast, IsUnknownFromFewViews) {
  EXPECT_EQ(seen_past(with_retreating_outlines(scan(carton, {6, kNoise_m}), 6)), 0.0);
  EXPECT_EQ(free_space_violation({}, {}, kNoise_m, kPixel_m), 0.0);
}

}  // namespace
}  // namespace turnscan::estimation
