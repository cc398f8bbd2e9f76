#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <turnscan/turntable/rotation.hpp>

#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

using motion::PlatterObservation;

double angle_deg(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegreesPerRadian;
}

DetectedPlatter platter_before_camera() {
  DetectedPlatter out;
  out.axis = Vec3d(0.02, -0.5, -0.85).normalized();
  out.center_m = Vec3d(0.01, 0.02, 0.7);
  out.radius_m = 0.12;
  return out;
}

SensorInfo camera() {
  SensorInfo out;
  out.intrinsics.width = 256, out.intrinsics.height = 212;
  out.intrinsics.fx = out.intrinsics.fy = 183.0;
  out.intrinsics.cx = 127.5, out.intrinsics.cy = 105.5;
  out.depth_unit_m = 1e-4;
  return out;
}

constexpr double kNoise_m = 0.0015;

/// Left of column `hidden` something 40 mm nearer stands before it.
DepthImage image_of_plane(const SensorInfo& sensor, const Vec3d& axis, const Vec3d& at,
                          int hidden = 0) {
  const CameraIntrinsics& c = sensor.intrinsics;
  DepthImage out;
  out.width = c.width, out.height = c.height;
  for (int y = 0; y < c.height; ++y) {
    for (int x = 0; x < c.width; ++x) {
      double z = axis.dot(at) / axis.dot(c.ray(x, y));
      if (x < hidden) z -= 0.04;
      z += kNoise_m * standard_normal(hash_key(7, std::uint64_t(y * c.width + x)));
      out.pixels.push_back(std::uint16_t(std::lround(z / sensor.depth_unit_m)));
    }
  }
  return out;
}

TEST(SeePlatter, TellsByHowMuchItLeansInOneFrame) {
  const SensorInfo sensor = camera();
  const RayTable rays(sensor.intrinsics);
  const DetectedPlatter platter = platter_before_camera();
  for (const double lean_deg : {0.0, 0.3, -1.5}) {
    for (const int hidden : {0, 120}) {
      const Vec3d axis =
          Eigen::AngleAxisd(lean_deg * kRadiansPerDegree, platter.axis.unitOrthogonal()) *
          platter.axis;
      const Vec3d at = platter.center_m + 0.002 * platter.axis;
      const auto sight = motion::fit_platter(image_of_plane(sensor, axis, at, hidden), sensor, rays,
                                             platter, kNoise_m);
      ASSERT_TRUE(sight) << lean_deg << " " << hidden;
      EXPECT_LT(angle_deg(sight->axis, axis), 4.0 * sight->slope_sigma * kDegreesPerRadian + 0.005);
      EXPECT_LT(sight->slope_sigma * kDegreesPerRadian, 0.08);
      EXPECT_NEAR(sight->height_m, 0.002, 0.0003);
    }
  }
}

TEST(SeePlatter, IsSilentWhereTooLittleOfItIsSeen) {
  const SensorInfo sensor = camera();
  const RayTable rays(sensor.intrinsics);
  const DetectedPlatter platter = platter_before_camera();
  DepthImage image = image_of_plane(sensor, platter.axis, platter.center_m, 256);
  EXPECT_FALSE(motion::fit_platter(image, sensor, rays, platter, kNoise_m))
      << "something before it";
  image = image_of_plane(sensor, platter.axis, platter.center_m);
  std::fill(image.pixels.begin(), image.pixels.end(), kOutsideCrop);
  EXPECT_FALSE(motion::fit_platter(image, sensor, rays, platter, kNoise_m)) << "cut out";
  image.pixels.clear();
  EXPECT_FALSE(motion::fit_platter(image, sensor, rays, platter, kNoise_m)) << "no image";
}

/// Sights of an axis that goes round a cone.
std::vector<std::optional<PlatterObservation>> cone(const DetectedPlatter& platter,
                                                    const Vec3d& middle, double lean_rad,
                                                    double way_rad, int frames) {
  std::vector<std::optional<PlatterObservation>> out;
  for (int i = 0; i < frames; ++i) {
    const Vec3d about = Eigen::AngleAxisd(way_rad * i / frames, middle) * middle.unitOrthogonal();
    PlatterObservation sight;
    sight.axis = Eigen::AngleAxisd(lean_rad, about) * middle;
    out.emplace_back(sight);
  }
  // It is told from the mean of all frames, however much of the cone they show.
  Vec3d mean = Vec3d::Zero();
  for (const auto& sight : out) mean += sight->axis;
  const auto R = Eigen::Quaterniond::FromTwoVectors(mean, platter.axis);
  for (auto& sight : out) sight->axis = R * sight->axis;
  return out;
}

TEST(Level, LaysAWobblingPlatterStillAboutTheMiddleOfItsCone) {
  const DetectedPlatter platter = platter_before_camera();
  auto sights = cone(platter, platter.axis, 0.01, 2.5 * std::numbers::pi, 40);
  const std::vector<std::optional<PlatterObservation>> all = sights;
  sights[11].reset();
  const auto found = motion::level(sights, platter);
  ASSERT_TRUE(found);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Pose& T = found->T_level_sensor[i];
    // The one that does not show it is turned as its neighbour.
    EXPECT_LT(angle_deg(T.linear() * all[i]->axis, found->axis), i == 11 ? 0.2 : 0.02) << i;
    EXPECT_LT((T * platter.center_m - platter.center_m).norm(), 1e-9);
    EXPECT_NEAR(angle_deg(all[i]->axis, found->axis), 0.01 * kDegreesPerRadian, 0.02);
  }
}

TEST(Level, LeavesAPlatterAloneThatLiesStillOrIsHardlySeen) {
  const DetectedPlatter platter = platter_before_camera();
  EXPECT_FALSE(motion::level({}, platter));
  EXPECT_FALSE(motion::level(cone(platter, platter.axis, 0.001, 6.0, 40), platter))
      << "leans by less than 0.1 degrees";
  auto noisy = cone(platter, platter.axis, 0.0, 6.0, 40);
  for (std::size_t i = 0; i < noisy.size(); ++i)
    noisy[i]->axis +=
        0.004 * Vec3d(standard_normal(hash_key(1, i)), standard_normal(hash_key(2, i)), 0.0);
  EXPECT_FALSE(motion::level(noisy, platter)) << "scatters from frame to frame";
  auto hidden = cone(platter, platter.axis, 0.01, 6.0, 40);
  ASSERT_TRUE(motion::level(hidden, platter));
  for (std::size_t i = 0; i < 10; ++i) hidden[i].reset();
  EXPECT_FALSE(motion::level(hidden, platter));
}

/// A small camera before a table whose axis goes twice round a cone of 0.6 degrees in one turn.
VirtualScan wobbling_scan(const std::string& object, double noise_mm, bool angles) {
  ScannerParameters parameters;
  parameters.columns = 320;
  parameters.rows = 264;
  parameters.fy = 230.0;
  parameters.near_m = 0.3;
  VirtualScanOptions options;
  VirtualScanner scanner{scanner_model(parameters).value(), {}};
  scanner.placement.distance_m = 0.6;
  scanner.placement.elevation_rad = 30.0 * kRadiansPerDegree;
  scanner.placement.aim_height_m = 0.06;
  options.scanners.push_back(scanner);
  options.motion.frames = 40;
  options.motion.turns = 1.3;
  options.record.angles = angles;
  options.motion.wobble_rad = 0.6 * kRadiansPerDegree;
  options.measure.noise = fmt::format("gaussian:{}mm", noise_mm);
  return VirtualScan::create({*builtin_object(object)}, options).value();
}

TEST(CalibrateFromMotion, TakesAWobbleOutThatThePlatterShows) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const VirtualScan scan = wobbling_scan("letter-a", 1.0, false);
  const auto found = calibrate_from_motion(scan, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_LT(angle_deg(found->table.axis, scan.turntable().axis), 0.04);
  double squares = 0.0;
  for (std::size_t i = 0; i < found->angles_rad.size(); ++i)
    squares += std::pow(found->angles_rad[i] - scan.angle_rad(i), 2);
  EXPECT_LT(std::sqrt(squares / double(found->angles_rad.size())) * kDegreesPerRadian, 0.1);
}

TEST(FindDisturbances, NamesAWobbleThatThePlatterShows) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const VirtualScan scan = wobbling_scan("letter-a", 3.0, true);
  const auto believed = frame_poses(scan.header(), scan.frames(), {});
  ASSERT_TRUE(believed) << believed.error().text();
  const auto found = find_disturbances(scan, believed->T_table_sensor, {});
  ASSERT_TRUE(found && *found);
  ASSERT_EQ((*found)->disturbances.size(), 1u);
  EXPECT_EQ((*found)->disturbances[0].text, "the table wobbles by 0.6 deg, 2 times a turn");
}

}  // namespace
}  // namespace turnscan
