#include <gtest/gtest.h>

#include <turnscan/capture/recorder/depth_crop.hpp>
#include <turnscan/core/parallel.hpp>
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

SensorInfo sensor_of(int width, int height, double unit_m = 1e-4) {
  SensorInfo sensor;
  sensor.intrinsics.width = width;
  sensor.intrinsics.height = height;
  sensor.intrinsics.fx = sensor.intrinsics.fy = 0.7 * width;
  sensor.intrinsics.cx = 0.5 * width;
  sensor.intrinsics.cy = 0.5 * height;
  sensor.depth_unit_m = unit_m;
  return sensor;
}

/// A sensor somewhere about the table, looking at it more or less.
Pose random_pose(std::uint64_t seed) {
  const auto u = [&](std::uint64_t i) { return uniform01(hash_key(seed, i)); };
  const double azimuth = 6.283 * u(0), elevation = -0.3 + 1.5 * u(1), distance = 0.3 + u(2);
  const Vec3d eye = distance * Vec3d(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                     std::cos(elevation) * std::cos(azimuth));
  const Vec3d forward = (Vec3d(0.1 * u(3), 0.2 * u(4), 0.1 * u(5)) - eye).normalized();
  const Vec3d right = forward.cross(Vec3d(0.1, 1.0, 0.05)).normalized();
  Pose pose = Pose::Identity();
  pose.linear().col(0) = right;
  pose.linear().col(1) = forward.cross(right);
  pose.linear().col(2) = forward;
  pose.translation() = eye;
  return pose;
}

Cylinder random_cylinder(std::uint64_t seed) {
  Cylinder cylinder;
  cylinder.margin_m = 0.02 * (uniform01(hash_key(seed, 20)) - 0.3);
  cylinder.height_m = 0.1 + 0.3 * uniform01(hash_key(seed, 21));
  cylinder.radius_m = 0.05 + 0.3 * uniform01(hash_key(seed, 22));
  return cylinder;
}

DepthImage random_image(const SensorInfo& sensor, std::uint64_t seed) {
  DepthImage depth(sensor.intrinsics.width, sensor.intrinsics.height);
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const std::uint64_t key = hash_key(seed, 99, i);
    depth.pixels[i] = static_cast<std::uint16_t>(0.02 / sensor.depth_unit_m +
                                                 uniform01(key) * 1.5 / sensor.depth_unit_m);
    if (key % 11 == 0) depth.pixels[i] = kNoReturn;
    if (key % 13 == 0) depth.pixels[i] = kOutsideCrop;
  }
  return depth;
}

/// Cells whose points the plain crop keeps.
std::vector<std::int32_t> kept_cells(const DepthImage& depth, const SensorInfo& sensor,
                                     const Pose& T, const Cylinder& cylinder) {
  Frame frame;
  frame.depth = depth;
  return crop(points_of(frame, sensor, RayTable(sensor.intrinsics)).value(),
              SensorCrop(cylinder, T))
      .cell;
}

TEST(DepthCrop, KeepsTheSamePixelsAsTheCropOfPoints) {
  std::size_t all = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SensorInfo sensor = sensor_of(61 + int(seed), 47, seed % 3 == 0 ? 1e-3 : 1e-4);
    if (seed % 4 == 0) sensor.depth_bias_m = -0.013;
    if (seed % 5 == 0) sensor.intrinsics.distortion = {0.1, -0.2, 0.001, 0.002, 0.05};
    const Pose T = random_pose(seed);
    const Cylinder cylinder = random_cylinder(seed);
    const DepthImage depth = random_image(sensor, seed);
    DepthImage cropped = depth;
    DepthCrop::create(cylinder, T, sensor)->apply(cropped);
    std::vector<std::int32_t> kept;
    for (std::size_t i = 0; i < cropped.pixels.size(); ++i) {
      if (cropped.pixels[i] == kNoReturn || cropped.pixels[i] == kOutsideCrop) continue;
      EXPECT_EQ(cropped.pixels[i], depth.pixels[i]);
      kept.push_back(std::int32_t(i));
    }
    EXPECT_EQ(kept, kept_cells(depth, sensor, T, cylinder)) << seed;
    all += kept.size();
  }
  EXPECT_GT(all, 1000u);
}

TEST(DepthCrop, KeepsOfAPixelTheVeryDepthsThatTheCropOfPointsKeeps) {
  const SensorInfo sensor = sensor_of(16, 12);
  const RayTable rays(sensor.intrinsics);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Pose T = random_pose(seed);
    const Cylinder cylinder = random_cylinder(seed);
    const DepthCrop crop = *DepthCrop::create(cylinder, T, sensor);
    const SensorCrop plain(cylinder, T);
    std::size_t wrong = 0;
    for (int raw = 1; raw < kOutsideCrop; ++raw) {
      DepthImage image(16, 12, std::uint16_t(raw));
      crop.apply(image);
      const float z = static_cast<float>(raw * sensor.depth_unit_m);
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const bool inside = plain.keeps(Vec3f(rays.x()[i] * z, rays.y()[i] * z, z));
        wrong += inside != (image.pixels[i] == raw) ? 1 : 0;
      }
    }
    EXPECT_EQ(wrong, 0u) << "seed " << seed;
  }
}

TEST(DepthCrop, IsTheSameForAnyNumberOfThreads) {
  const SensorInfo sensor = sensor_of(200, 120);
  DepthImage one = random_image(sensor, 7), all = one;
  set_thread_count(1);
  DepthCrop::create(random_cylinder(7), random_pose(7), sensor)->apply(one);
  set_thread_count(0);
  DepthCrop::create(random_cylinder(7), random_pose(7), sensor)->apply(all);
  EXPECT_EQ(one.pixels, all.pixels);
}

TEST(DepthCrop, RefusesSensorsWithoutDepthImages) {
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  EXPECT_EQ(DepthCrop::create({}, random_pose(1), scanner).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(DepthCrop::create({}, random_pose(1), SensorInfo()).error().code, ErrorCode::kFormat);
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
