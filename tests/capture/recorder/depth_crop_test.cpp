#include <gtest/gtest.h>

#include <turnscan/capture/recorder/depth_crop.hpp>
#include <turnscan/core/random.hpp>

namespace turnscan {
namespace {

SensorInfo camera() {
  SensorInfo sensor;
  sensor.intrinsics.width = 64;
  sensor.intrinsics.height = 48;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 60.0;
  sensor.intrinsics.cx = 31.5;
  sensor.intrinsics.cy = 23.5;
  sensor.intrinsics.distortion = {0.05, -0.02, 0.001, 0.0005, 0.0};
  sensor.depth_unit_m = 1e-4;
  sensor.depth_bias_m = 0.003;
  return sensor;
}

/// Looks down at the table from 0.9 m away.
Pose looking_down() {
  Pose pose = Pose::Identity();
  const Vec3d z = Vec3d(0.1, -0.5, 0.8).normalized();
  const Vec3d x = Vec3d::UnitY().cross(z).normalized() * -1.0;
  const Vec3d y = z.cross(x);
  pose.linear().col(0) = x;
  pose.linear().col(1) = y;
  pose.linear().col(2) = z;
  pose.translation() = -0.9 * z;
  return pose;
}

TEST(DepthCrop, KeepsWhatTheCylinderContainsAndTellsBeforeFromBehind) {
  const SensorInfo sensor = camera();
  const Pose pose = looking_down();
  const Cylinder cylinder{-0.01, 0.2, 0.15};
  const DepthCrop crop = *DepthCrop::create(cylinder, pose, sensor);
  const RayTable rays(sensor.intrinsics);
  std::size_t kept = 0, before = 0, behind = 0;
  for (std::uint64_t round = 0; round < 30; ++round) {
    DepthImage image(64, 48);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] =
          static_cast<std::uint16_t>(i % 17 == 0 ? 0 : 4000 + 9000 * uniform01(hash_key(round, i)));
    DepthImage cropped = image;
    crop.apply(cropped);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      if (image.pixels[i] == kNoReturn) {
        EXPECT_EQ(cropped.pixels[i], kNoReturn);
        continue;
      }
      const double z = image.pixels[i] * sensor.depth_unit_m + sensor.depth_bias_m;
      const Vec3d ray(double(rays.x()[i]), double(rays.y()[i]), 1.0);
      const bool inside = cylinder.contains(pose * (z * ray));
      if (inside) {
        ++kept;
        EXPECT_EQ(cropped.pixels[i], image.pixels[i]);
      } else {
        // Does the ray still reach the cylinder?
        bool reaches = false;
        for (double further = z; further < 3.0; further += 5e-4)
          reaches = reaches || cylinder.contains(pose * (further * ray));
        ++(reaches ? before : behind);
        EXPECT_EQ(cropped.pixels[i], reaches ? kNoReturn : kOutsideCrop) << i << " at " << z;
      }
    }
    if (round > 2) break;
  }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(before, 100u);
  EXPECT_GT(behind, 100u);
}

TEST(DepthCrop, CroppingTwiceIsCroppingOnce) {
  const DepthCrop crop = *DepthCrop::create(Cylinder{0.0, 0.2, 0.15}, looking_down(), camera());
  DepthImage image(64, 48, 9000);
  crop.apply(image);
  DepthImage again = image;
  crop.apply(again);
  EXPECT_EQ(again.pixels, image.pixels);
}

TEST(DepthCrop, RefusesAnImageOfAnotherSize) {
  const DepthCrop crop = *DepthCrop::create(Cylinder{}, looking_down(), camera());
  DepthImage image(3, 3);
  EXPECT_THROW(crop.apply(image), std::invalid_argument);
}

}  // namespace
}  // namespace turnscan
