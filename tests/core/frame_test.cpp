#include <gtest/gtest.h>

#include <limits>
#include <turnscan/core/frame.hpp>

namespace turnscan {
namespace {

// A camera of 3 x 2 pixels, 1 mm per step, and an image with a return in every pixel.
SensorInfo small_sensor() {
  SensorInfo sensor;
  sensor.intrinsics.width = 3;
  sensor.intrinsics.height = 2;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 100.0;
  sensor.intrinsics.cx = 1.0;
  sensor.intrinsics.cy = 0.5;
  sensor.depth_unit_m = 1e-3;
  return sensor;
}

Frame depth_frame(std::vector<std::uint16_t> raw) {
  Frame frame;
  frame.info.file = "depth/000000.png";
  frame.depth = DepthImage(3, 2);
  frame.depth.pixels = std::move(raw);
  return frame;
}

FramePoints points(const Frame& frame, const SensorInfo& sensor) {
  const Result<FramePoints> r = points_of(frame, sensor, RayTable(sensor.intrinsics));
  EXPECT_TRUE(r) << r.error().text();
  return r.value_or(FramePoints());
}

ErrorCode refusal(const Frame& frame, const SensorInfo& sensor) {
  const Result<FramePoints> r = points_of(frame, sensor, RayTable(sensor.intrinsics));
  EXPECT_FALSE(r);
  return r ? ErrorCode::kLibrary : r.error().code;
}

TEST(PointsOfDepth, NoReturnAndOutsideTheCropAreLeftOut) {
  const FramePoints p =
      points(depth_frame({kNoReturn, 1000, kOutsideCrop, 1, 65534, 0}), small_sensor());
  EXPECT_EQ(p.cell, (std::vector<std::int32_t>{1, 3, 4}));
  EXPECT_EQ(p.cloud.size(), 3u);
  EXPECT_EQ(p.width, 3);
  EXPECT_EQ(p.height, 2);
}

TEST(PointsOfDepth, PointIsRayTimesDepthWithUnitAndBias) {
  SensorInfo sensor = small_sensor();
  sensor.depth_bias_m = 0.5;
  const FramePoints p = points(depth_frame({0, 0, 1000, 0, 0, 0}), sensor);
  ASSERT_EQ(p.cloud.size(), 1u);
  EXPECT_TRUE(p.cloud.points[0].isApprox(Vec3f(0.01f * 1.5f, -0.005f * 1.5f, 1.5f)));
}

TEST(PointsOfDepth, PointsNotInFrontOfTheSensorAreLeftOut) {
  SensorInfo sensor = small_sensor();
  sensor.depth_bias_m = -0.010;  // 10 mm, the depth of the first pixel
  const FramePoints p = points(depth_frame({10, 9, 11, 0, 0, 0}), sensor);
  EXPECT_EQ(p.cell, std::vector<std::int32_t>{2});
}

TEST(PointsOfDepth, PixelsWithoutARayAreLeftOut) {
  SensorInfo sensor = small_sensor();
  sensor.intrinsics.fx = sensor.intrinsics.fy = 1.5;  // the outer columns are at x = 0.67
  sensor.intrinsics.distortion = {-0.5, 0, 0, 0, 0};
  const FramePoints p = points(depth_frame({500, 500, 500, 500, 500, 500}), sensor);
  EXPECT_EQ(p.cell, (std::vector<std::int32_t>{1, 4}));
}

TEST(PointsOfDepth, PointsThatAreNotFiniteAreLeftOut) {
  SensorInfo sensor = small_sensor();
  sensor.depth_unit_m = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(points(depth_frame({1, 1, 1, 1, 1, 1}), sensor).cloud.empty());
}

TEST(PointsOfDepth, RegisteredColourComesFromTheSamePixel) {
  Frame frame = depth_frame({0, 1000, 0, 0, 0, 900});
  frame.color = ColorImage(3, 2);
  frame.color.at(1, 0) = {10, 20, 30};
  frame.color.at(2, 1) = {40, 50, 60};
  const FramePoints p = points(frame, small_sensor());
  EXPECT_EQ(p.cloud.colors, (std::vector<Rgb>{{10, 20, 30}, {40, 50, 60}}));
}

TEST(PointsOfDepth, ColourOfAnotherSizeWithoutACameraIsNotUsed) {
  Frame frame = depth_frame({0, 1000, 0, 0, 0, 900});
  frame.color = ColorImage(6, 4);
  EXPECT_TRUE(points(frame, small_sensor()).cloud.colors.empty());
}

TEST(PointsOfDepth, UnregisteredColourIsLookedUpThroughItsOwnCamera) {
  SensorInfo sensor = small_sensor();
  CameraIntrinsics color = sensor.intrinsics;
  color.width = 60;
  color.height = 40;
  color.fx = color.fy = 2000.0;
  color.cx = 29.5;
  color.cy = 19.5;
  sensor.color_intrinsics = color;
  sensor.T_color_sensor.translation() = Vec3d(0.01, 0.0, 0.0);  // half a depth pixel at 1 m: 20 px
  Frame frame = depth_frame({0, 1000, 1000, 0, 0, 0});
  frame.color = ColorImage(60, 40);
  frame.color.at(50, 10) = {1, 2, 3};  // u = 29.5 + 20 = 49.5, v = 19.5 - 10 = 9.5; halves go up
  const FramePoints p = points(frame, sensor);
  ASSERT_EQ(p.cloud.colors.size(), 2u);
  EXPECT_EQ(p.cloud.colors[0], (Rgb{1, 2, 3}));
  EXPECT_EQ(p.cloud.colors[1], Rgb()) << "outside the colour image: black";
}

TEST(PointsOfDepth, ImageOfAnotherSizeThanTheSensorIsAnErrorThatNamesTheFile) {
  Frame frame = depth_frame({1, 1, 1, 1, 1, 1});
  frame.depth = DepthImage(2, 3, 1);
  EXPECT_EQ(refusal(frame, small_sensor()), ErrorCode::kFormat);
  const SensorInfo sensor = small_sensor();
  EXPECT_EQ(points_of(frame, sensor, RayTable(sensor.intrinsics)).error().path, frame.info.file);
}

Frame scan_frame() {
  Frame frame;
  frame.points.points = {{0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
  frame.points.colors = {{1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  return frame;
}

TEST(PointsOfScan, WithoutAGridKeepTheirOrder) {
  Frame frame = scan_frame();
  frame.points.points[1].x() = std::numeric_limits<float>::quiet_NaN();
  const FramePoints p = points(frame, small_sensor());
  EXPECT_EQ(p.cloud.points, (std::vector<Vec3f>{{0, 0, 1}, {1, 0, 1}}));
  EXPECT_EQ(p.cloud.colors, (std::vector<Rgb>{{1, 1, 1}, {3, 3, 3}}));
  EXPECT_TRUE(p.cell.empty());
  EXPECT_EQ(p.width, 0);
}

TEST(PointsOfScan, WithAGridComeInTheOrderOfCells) {
  Frame frame = scan_frame();
  frame.grid_width = 2;
  frame.grid_height = 2;
  frame.grid = {2, -1, 0, 1};
  frame.points.points[0].z() = std::numeric_limits<float>::infinity();
  const FramePoints p = points(frame, small_sensor());
  EXPECT_EQ(p.cloud.points, (std::vector<Vec3f>{{1, 0, 1}, {0, 1, 1}}));
  EXPECT_EQ(p.cell, (std::vector<std::int32_t>{0, 3}));
  EXPECT_EQ(p.width, 2);
  EXPECT_EQ(p.height, 2);
}

TEST(PointsOfScan, GridThatDoesNotFitIsRefused) {
  Frame frame = scan_frame();
  frame.grid_width = 2;
  frame.grid_height = 2;
  frame.grid = {0, 1, 2};
  EXPECT_EQ(refusal(frame, small_sensor()), ErrorCode::kFormat) << "three cells for 2 x 2";
  frame.grid = {0, 1, 2, 3};
  EXPECT_EQ(refusal(frame, small_sensor()), ErrorCode::kFormat) << "there is no fourth point";
  frame.grid_width = frame.grid_height = -2;
  frame.grid = {0, 1, 2, -1};
  EXPECT_EQ(refusal(frame, small_sensor()), ErrorCode::kFormat) << "negative sizes";
}

TEST(PointsOf, AFrameWithoutDataHasNoPoints) {
  EXPECT_TRUE(points(Frame(), small_sensor()).cloud.empty());
}

TEST(PointsOf, ViewpointIsTheSensors) {
  SensorInfo sensor = small_sensor();
  sensor.viewpoint = {Vec3d(0, 0, -1), true};
  EXPECT_TRUE(points(scan_frame(), sensor).viewpoint.parallel);
  EXPECT_TRUE(points(depth_frame({1, 1, 1, 1, 1, 1}), sensor).viewpoint.parallel);
}

TEST(Viewpoint, APositionIsSeenFromEachPointInItsOwnDirection) {
  const Viewpoint v{Vec3d(0, 0, 2), false};
  EXPECT_EQ(v.direction_from({0, 0, 0}), Vec3d(0, 0, 1));
  EXPECT_EQ(v.direction_from({3, 0, 2}), Vec3d(-1, 0, 0));
  EXPECT_EQ(v.direction_from({0, 0, 2}), Vec3d::Zero()) << "at the sensor itself";
}

TEST(Viewpoint, AParallelOneIsTheSameDirectionEverywhere) {
  const Viewpoint v{Vec3d(0, 0, 1), true};
  EXPECT_EQ(v.direction_from({5, 6, 7}), Vec3d(0, 0, 1));
}

TEST(Viewpoint, ADirectionTurnsButDoesNotMove) {
  Pose pose = rotation_about_y(std::acos(-1.0) / 2);
  pose.translation() = Vec3d(1, 2, 3);
  EXPECT_TRUE(Viewpoint({Vec3d::UnitZ(), true}).transformed(pose).value.isApprox(Vec3d::UnitX()));
  EXPECT_TRUE(Viewpoint({Vec3d::UnitZ(), false}).transformed(pose).value.isApprox(Vec3d(2, 2, 3)));
}

}  // namespace
}  // namespace turnscan
