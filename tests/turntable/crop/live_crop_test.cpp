#include <gtest/gtest.h>

#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/turntable/crop/crop_kernel.hpp>
#include <turnscan/turntable/crop/live_crop.hpp>

namespace turnscan {
namespace {

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

/// The slow, plain way.
FramePoints slowly(const DepthImage& depth, const SensorInfo& sensor, const Pose& T,
                   const Cylinder& cylinder, const ColorImage& color = {}) {
  Frame frame;
  frame.depth = depth;
  frame.color = color;
  return crop(points_of(frame, sensor, RayTable(sensor.intrinsics)).value(),
              SensorCrop(cylinder, T));
}

TEST(LiveCrop, KeepsTheSamePointsAsTheSlowCrop) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    // Sizes that are not whole words, too.
    SensorInfo sensor = sensor_of(61 + int(seed), 47, seed % 3 == 0 ? 1e-3 : 1e-4);
    if (seed % 4 == 0) sensor.depth_bias_m = -0.013;
    if (seed % 5 == 0) sensor.intrinsics.distortion = {0.1, -0.2, 0.001, 0.002, 0.05};
    const Pose T = random_pose(seed);
    const Cylinder cylinder = random_cylinder(seed);
    const DepthImage depth = random_image(sensor, seed);
    const auto live = LiveCrop::create(sensor, T, cylinder);
    ASSERT_TRUE(live);
    const auto fast = live->points(depth);
    ASSERT_TRUE(fast);
    const FramePoints slow = slowly(depth, sensor, T, cylinder);
    EXPECT_EQ(fast->cell, slow.cell) << seed;
    EXPECT_TRUE(fast->cloud.points == slow.cloud.points) << seed;
    EXPECT_EQ(fast->width, slow.width);
    EXPECT_TRUE(fast->cloud.colors.empty());
  }
}

TEST(LiveCrop, TheDepthsOfAPixelInsideTheCylinderAreOneInterval) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const SensorInfo sensor = sensor_of(16, 12);
    const Pose T = random_pose(seed);
    const Cylinder cylinder = random_cylinder(seed);
    const auto live = LiveCrop::create(sensor, T, cylinder);
    ASSERT_TRUE(live);
    const SensorCrop slow(cylinder, T);
    const RayTable rays(sensor.intrinsics);
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column < 16; ++column) {
        const auto kept = live->interval(column, row);
        const std::size_t i = std::size_t(row) * 16 + std::size_t(column);
        std::size_t wrong = 0;
        for (int raw = 1; raw < kOutsideCrop; ++raw) {
          const float z = static_cast<float>(raw * sensor.depth_unit_m);
          const bool inside = slow.keeps(Vec3f(rays.x()[i] * z, rays.y()[i] * z, z));
          wrong += inside != (raw >= kept.first && raw < kept.first + kept.count) ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0u) << "seed " << seed << ", pixel " << column << ", " << row;
      }
  }
}

TEST(LiveCrop, TheImageTellsWhatWasSeenOutsideFromWhatWasNotSeen) {
  const SensorInfo sensor = sensor_of(70, 50);
  const Pose T = random_pose(3);
  const Cylinder cylinder = random_cylinder(3);
  const DepthImage depth = random_image(sensor, 3);
  const auto live = LiveCrop::create(sensor, T, cylinder);
  const auto image = live->image(depth);
  ASSERT_TRUE(image);
  std::vector<bool> kept(depth.pixels.size());
  for (const std::int32_t cell : slowly(depth, sensor, T, cylinder).cell)
    kept[std::size_t(cell)] = true;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::uint16_t raw = depth.pixels[i];
    EXPECT_EQ(image->pixels[i], raw == kNoReturn ? kNoReturn : kept[i] ? raw : kOutsideCrop);
    inside += kept[i] ? 1 : 0;
  }
  EXPECT_GT(inside, 20u);
  // Cropping it again changes nothing.
  EXPECT_EQ(live->image(*image)->pixels, image->pixels);
}

TEST(LiveCrop, AllInstructionSetsSelectTheSamePixels) {
  const std::size_t n = 64 * 37;
  std::vector<std::uint16_t> raw(n), first(n), count(n);
  for (std::size_t i = 0; i < n; ++i) {
    raw[i] = static_cast<std::uint16_t>(hash_key(1, i));
    first[i] = static_cast<std::uint16_t>(hash_key(2, i));
    count[i] = static_cast<std::uint16_t>(hash_key(3, i));
    if (i % 5 == 0) raw[i] = static_cast<std::uint16_t>(first[i] + i % 3);
    if (i % 7 == 0) count[i] = static_cast<std::uint16_t>(i % 3);
    if (i % 11 == 0) raw[i] = static_cast<std::uint16_t>(first[i] + count[i] - 1 + i % 2);
    if (i % 13 == 0) first[i] = 0, count[i] = 65535, raw[i] = i % 2 == 0 ? 65535 : 0;
  }
  std::vector<std::uint64_t> expected(n / 64);
  for (std::size_t i = 0; i < n; ++i)
    if (static_cast<std::uint16_t>(raw[i] - first[i]) < count[i])
      expected[i / 64] |= std::uint64_t(1) << (i % 64);
  for (const InstructionSet set :
       {InstructionSet::kPortable, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const crop_kernel::CropKernel* kernel = crop_kernel::CropKernels::find(set);
    if (kernel == nullptr) continue;
    std::vector<std::uint64_t> bits(n / 64, 0x5555);
    kernel->select(raw.data(), first.data(), count.data(), n, bits.data());
    EXPECT_EQ(bits, expected) << static_cast<int>(set);
  }
}

TEST(LiveCrop, ColoursComeWithTheirPoints) {
  const SensorInfo sensor = sensor_of(40, 30);
  const DepthImage depth = random_image(sensor, 5);
  ColorImage color(40, 30);
  for (std::size_t i = 0; i < color.pixels.size(); ++i)
    color.pixels[i] = {std::uint8_t(i), std::uint8_t(i >> 8), 9};
  const auto live = LiveCrop::create(sensor, random_pose(5), random_cylinder(5));
  const auto points = live->points(depth, color);
  ASSERT_EQ(points->cloud.colors.size(), points->cloud.size());
  EXPECT_TRUE(points->cloud.colors ==
              slowly(depth, sensor, random_pose(5), random_cylinder(5), color).cloud.colors);
  EXPECT_TRUE(live->points(depth, ColorImage(3, 3))->cloud.colors.empty());
}

TEST(LiveCrop, IsTheSameForAnyNumberOfThreads) {
  const SensorInfo sensor = sensor_of(200, 120);
  const DepthImage depth = random_image(sensor, 7);
  set_thread_count(1);
  const auto one = LiveCrop::create(sensor, random_pose(7), random_cylinder(7))->points(depth);
  set_thread_count(0);
  const auto all = LiveCrop::create(sensor, random_pose(7), random_cylinder(7))->points(depth);
  EXPECT_EQ(one->cell, all->cell);
}

TEST(LiveCrop, RefusesWhatDoesNotFit) {
  const SensorInfo sensor = sensor_of(40, 30);
  const auto live = LiveCrop::create(sensor, random_pose(5), random_cylinder(5));
  EXPECT_EQ(live->points(DepthImage(39, 30)).error().code, ErrorCode::kFormat);
  EXPECT_EQ(live->image(DepthImage(40, 31)).error().code, ErrorCode::kFormat);
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  EXPECT_EQ(LiveCrop::create(scanner, random_pose(1), {}).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(LiveCrop::create(SensorInfo(), random_pose(1), {}).error().code, ErrorCode::kFormat);
}

TEST(LiveCropOptions, KeepTheCylinderAwayFromPlatterAndRim) {
  TurntableInfo table;
  EXPECT_EQ(live_cylinder(table, {}).error().code, ErrorCode::kMissingData);
  table.radius_m = 0.15;
  const auto cylinder = live_cylinder(table, {});
  ASSERT_TRUE(cylinder);
  EXPECT_DOUBLE_EQ(cylinder->margin_m, 0.006);
  EXPECT_DOUBLE_EQ(cylinder->radius_m, 0.145);
  LiveCropOptions options;
  options.inset_m = 0.2;
  EXPECT_EQ(live_cylinder(table, options).error().code, ErrorCode::kMissingData);
  options.inset_m = std::nan("");
  EXPECT_EQ(live_cylinder(table, options).error().code, ErrorCode::kInvalidOption);
  options = {};
  options.margin_m = 0.3;
  EXPECT_EQ(live_cylinder(table, options).error().code, ErrorCode::kInvalidOption);
  options = {};
  options.height_m = 0.0;
  EXPECT_EQ(live_cylinder(table, options).error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
