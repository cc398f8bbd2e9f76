#include <gtest/gtest.h>

#include <turnscan/workflow/calibration/reduced_frames.hpp>

#include "tests/support/memory_sequence.hpp"

namespace turnscan {
namespace {

testing::MemorySequence one_image(int width, int height) {
  testing::MemorySequence out;
  SensorInfo sensor;
  sensor.intrinsics = {width, height, 1.1 * width, 1.2 * width, 0.5 * width, 0.4 * height, {}};
  sensor.intrinsics.distortion[0] = -0.05;
  out.header_value.sensors = {sensor};
  Frame frame;
  frame.depth = DepthImage(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      frame.depth.at(x, y) = std::uint16_t(1 + (x * 7 + y * 13) % 999);
  frame.color = ColorImage(width, height);
  frame.color_jpeg = "not looked at";
  out.add(frame);
  return out;
}

TEST(ReducedFrames, KeepPixelsWhereTheirRaysWere) {
  const auto large = one_image(2048, 1535);
  const SequenceView small = workflow::reduced_frames(large);
  const CameraIntrinsics &before = large.header().sensors[0].intrinsics,
                         &after = small.header().sensors[0].intrinsics;
  EXPECT_EQ(after.width, 1024);
  EXPECT_EQ(after.height, 768);
  const auto frame = small.read(0), original = large.read(0);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->depth.width, after.width);
  EXPECT_EQ(frame->depth.height, after.height);
  EXPECT_TRUE(frame->color.empty());
  EXPECT_TRUE(frame->color_jpeg.empty());
  for (const auto& [x, y] : {std::pair(0, 0), {1023, 0}, {0, 767}, {517, 301}, {1023, 767}}) {
    EXPECT_EQ(frame->depth.at(x, y), original->depth.at(2 * x, 2 * y));
    EXPECT_LT((after.ray(x, y) - before.ray(2.0 * x, 2.0 * y)).norm(), 1e-9);
  }
}

TEST(ReducedFrames, AreNotTouchedWhereTheyAreSmallEnough) {
  const auto images = one_image(1280, 720);
  const SequenceView view = workflow::reduced_frames(images);
  const auto frame = view.read(0), original = images.read(0);
  ASSERT_TRUE(frame);
  EXPECT_EQ(view.header().sensors[0].intrinsics.fx, images.header().sensors[0].intrinsics.fx);
  EXPECT_EQ(frame->depth.pixels, original->depth.pixels);
  EXPECT_EQ(frame->color.pixels, original->color.pixels);
  EXPECT_EQ(frame->color_jpeg, original->color_jpeg);
}

TEST(ReducedFrames, HaveAtMost1600000Pixels) {
  for (const auto& [width, height] :
       {std::pair(1600, 1000), {1601, 1000}, {4000, 3000}, {9000, 1}}) {
    const auto images = one_image(width, height);
    const SequenceView view = workflow::reduced_frames(images);
    const auto& camera = view.header().sensors[0].intrinsics;
    EXPECT_LE(double(camera.width) * camera.height, 1.61e6);
    EXPECT_GE(double(camera.width) * camera.height, std::min(double(width) * height, 0.4e6));
  }
}

TEST(ReducedFrames, AreCoarserForChecksWhereImagesAreLarge) {
  for (const auto& [width, height, coarser] :
       {std::tuple(512, 424, false), {848, 480, false}, {1024, 768, true}, {2048, 1536, true}}) {
    const auto images = one_image(width, height);
    EXPECT_EQ(workflow::are_coarser_for_checks(images.header()), coarser) << width;
    const SequenceView view = workflow::reduced_frames(images, workflow::kPixelsToCheck);
    const auto& camera = view.header().sensors[0].intrinsics;
    EXPECT_LE(double(camera.width) * camera.height, 1.01 * workflow::kPixelsToCheck);
  }
}

TEST(ReducedFrames, LeavePointsOfScannersAlone) {
  testing::MemorySequence scans;
  SensorInfo sensor;
  sensor.kind = SensorKind::kPointScanner;
  scans.header_value.sensors = {sensor};
  Frame frame;
  frame.points.points = {Vec3f(1.0f, 2.0f, 3.0f)};
  scans.add(frame);
  const auto read = workflow::reduced_frames(scans).read(0);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->points.points, frame.points.points);
}

}  // namespace
}  // namespace turnscan
