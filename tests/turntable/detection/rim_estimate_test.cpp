#include <gtest/gtest.h>

#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/turntable/detection/detect.hpp>
#include <turnscan/turntable/detection/residual_correlation.hpp>
#include <turnscan/turntable/detection/rim_model.hpp>

#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

using detection::Plane;
using detection::PlaneFrame;
using detection::RimModel;
using detection::RimView;

ScannerParameters kinect_v2_parameters() {
  ScannerParameters parameters;
  parameters.columns = 512;
  parameters.rows = 424;
  parameters.fy = 365.5;
  parameters.near_m = 0.3;
  parameters.noise.physics = SensorPhysics::kKinectV2;
  parameters.noise.footprint_px = 1.0;
  return parameters;
}

ScannerModel kinect_v2() { return scanner_model(kinect_v2_parameters()).value(); }

VirtualScanOptions table(double distance_m, double elevation_deg, double thickness_m,
                         const std::string& noise, double mixed_pixels, int seed = 1) {
  VirtualScanOptions options;
  VirtualScanner scanner{kinect_v2(), {}};
  scanner.placement.distance_m = distance_m;
  scanner.placement.elevation_rad = elevation_deg * kRadiansPerDegree;
  scanner.placement.aim_height_m = 0.03;
  options.scanners.push_back(scanner);
  options.platter.thickness_m = thickness_m;
  options.table.x_m = 0.004;
  options.table.tilt_rad = 1.0 * kRadiansPerDegree;
  options.room.kind = RoomKind::kWall;
  options.measure.noise = noise;
  options.measure.mixed_pixels = mixed_pixels;
  options.measure.seed = seed;
  options.motion.frames = 8;
  return options;
}

struct Detected {
  DetectedPlatter platter;
  Vec3d offset_m;  ///< of the centre from the truth
  double axis_error_rad, height_error_m, center_error_m, radius_error_m;
};

Detected detect(const VirtualScanOptions& options) {
  const VirtualScan scan = VirtualScan::create({}, options).value();
  const AveragedScan averaged = average_frames(scan, spread_positions(scan, 0, 8), {}, {}).value();
  const auto platter = detect_platter(averaged, {}, {});
  EXPECT_TRUE(platter) << platter.error().text();
  if (!platter) return {};
  const TurntableInfo& truth = scan.turntable();
  const Vec3d offset = platter->center_m - truth.center_m;
  const double height = offset.dot(truth.axis);
  return {*platter,
          offset,
          std::atan2(platter->axis.cross(truth.axis).norm(), platter->axis.dot(truth.axis)),
          height,
          (offset - height * truth.axis).norm(),
          platter->radius_m - options.platter.radius_m};
}

// A circle through the ends of what looks like the surface was 3.5 mm off here.
TEST(DetectPlatter, TheCentreDoesNotMoveWithTheWallThatIsSeenBelowTheRim) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const double thickness_m : {0.0, 0.003, 0.006, 0.012, 0.025}) {
    const Detected d = detect(table(1.08, 17.0, thickness_m, "gaussian:1.5mm", 0.5));
    EXPECT_LT(d.center_error_m, 0.0008) << thickness_m;
    EXPECT_LT(d.center_error_m, 3.0 * d.platter.center_sigma_m) << thickness_m;
    EXPECT_LT(d.platter.center_sigma_m, 0.0015) << thickness_m;
  }
}

TEST(DetectPlatter, TheRadiusDoesNotDependOnHowManyPixelsMix) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const double share : {0.0, 0.2, 1.0}) {
    const Detected d = detect(table(0.9, 25.0, 0.01, "gaussian:1.5mm", share));
    EXPECT_LT(std::abs(d.radius_error_m), 0.0006) << share;
    EXPECT_LT(d.center_error_m, 0.0006) << share;
  }
}

TEST(DetectPlatter, StatesDeviationsLikeItsErrorsForEveryKindOfNoise) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const char* noise : {"gaussian:1.5mm", "physics"}) {
    double axis = 0.0, height = 0.0, center = 0.0, radius = 0.0;
    constexpr int kTables = testing::repetitions(8, 2);
    for (int seed = 1; seed <= kTables; ++seed) {
      const Detected d =
          detect(table(0.75 + 0.05 * seed, 14.0 + 3.0 * seed, 0.003 * seed, noise, 0.0, seed));
      const auto ratio2 = [](double error, double sigma) { return error * error / sigma / sigma; };
      axis += ratio2(d.axis_error_rad, d.platter.axis_sigma_rad) / kTables;
      height += ratio2(d.height_error_m, d.platter.height_sigma_m) / kTables;
      center += ratio2(d.center_error_m, d.platter.center_sigma_m) / kTables;
      radius += ratio2(d.radius_error_m, d.platter.radius_sigma_m) / kTables;
    }
    for (const double mean : {axis, height, center, radius}) {
      EXPECT_GT(mean, kTables < 8 ? 0.0 : 0.02) << noise;
      EXPECT_LT(mean, kTables < 8 ? 9.0 : 3.0) << noise;
    }
  }
}

TriangleMesh box(double half_x, double height, double half_z) {
  TriangleMesh mesh;
  for (int c = 0; c < 8; ++c)
    mesh.vertices.emplace_back(float(c & 1 ? half_x : -half_x), float(c & 2 ? height : 0.0),
                               float(c & 4 ? half_z : -half_z));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// A low wall and a rim that lies nearer look much alike at low angles: the wrong one was 22 mm off
// at 15 deviations.
TEST(DetectPlatter, IsHonestOrRefusesWhereABareDiscMayAsWellHaveAWall) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const int seed : {1, 4, 10, 11}) {
    VirtualScanOptions options =
        table(0.95 + 0.03 * seed, 13.0 + 0.3 * seed, 0.0, "physics", 0.0, seed);
    options.platter.radius_m = 0.213;
    options.motion.frames = 24;
    ScannerParameters parameters = kinect_v2_parameters();
    parameters.near_m = 0.5;
    parameters.noise.mixed_rejection_m = 0.04;
    parameters.noise.dark_signal_per_m2 = 0.0067;
    parameters.noise.dark_jitter = 0.1;
    options.scanners[0].model = scanner_model(parameters).value();
    const VirtualScan scan = VirtualScan::create({}, options).value();
    const auto averaged = average_frames(scan, spread_positions(scan, 0, 24), {}, {});
    ASSERT_TRUE(averaged);
    const auto platter = detect_platter(*averaged, {}, {});
    if (!platter) continue;
    const TurntableInfo& truth = scan.turntable();
    const Vec3d offset = platter->center_m - truth.center_m;
    const double off = (offset - offset.dot(truth.axis) * truth.axis).norm();
    EXPECT_LT(off, 0.001 + 3.0 * platter->center_sigma_m) << seed;
  }
}

TEST(DetectPlatter, RefusesSquareThingsWhateverTheirSize) {
  for (const double half_m : {0.06, 0.1, 0.16}) {
    VirtualScanOptions options = table(0.9, 35.0, 0.0, "gaussian:1.5mm", 0.5);
    options.platter.visible = false;
    options.motion.turns = 1e-9;
    const VirtualScan scan = VirtualScan::create({box(half_m, 0.03, half_m)}, options).value();
    const AveragedScan averaged =
        average_frames(scan, spread_positions(scan, 0, 8), {}, {}).value();
    const auto platter = detect_platter(averaged, {}, {});
    ASSERT_FALSE(platter) << half_m << " taken for radius " << platter->radius_m;
    EXPECT_EQ(platter.error().code, ErrorCode::kMissingData);
  }
}

CameraIntrinsics camera() {
  CameraIntrinsics camera;
  camera.width = 512, camera.height = 424;
  camera.fx = camera.fy = 365.5;
  camera.cx = 255.5, camera.cy = 211.5;
  return camera;
}

const Plane kPlane{Vec3d(0.05, -0.5, -0.86).normalized(), -0.6};

TEST(RimView, TheOutlineIsWhereTheRimIsSeenAndFallsByOneForEachPixelOutwards) {
  const CameraIntrinsics c = camera();
  const PlaneFrame frame(kPlane, Vec3d(0.0, 0.0, 0.7));
  const RimView view(c, kPlane, frame);
  const RimModel disc{{0.01, -0.02}, 0.15, 0.0};
  for (int k = 0; k < 36; ++k) {
    const double a = kTurn * k / 36.0;
    const Vec3d p =
        frame.to_space(disc.center + disc.radius_m * Eigen::Vector2d(std::cos(a), std::sin(a)));
    const Eigen::Vector2d uv = c.project(p);
    EXPECT_NEAR(view.outline(disc, uv.x(), uv.y())->px, 0.0, 1e-6);
    const double across = std::abs(view.outline(disc, uv.x() + 1.0, uv.y())->px);
    const double down = std::abs(view.outline(disc, uv.x(), uv.y() + 1.0)->px);
    EXPECT_NEAR(std::max(across, down), 1.0, 0.03) << k;
  }
}

TEST(RimView, GradientsAreThoseOfTheDistanceAndOfTheDepth) {
  const CameraIntrinsics c = camera();
  const PlaneFrame frame(kPlane, Vec3d(0.0, 0.0, 0.7));
  const RimView view(c, kPlane, frame);
  const RimModel model{{0.01, -0.02}, 0.15, 0.02};
  const auto changed = [&](int unknown, double by) {
    RimModel m = model;
    if (unknown < 2) m.center[unknown] += by;
    if (unknown == 2) m.radius_m += by;
    if (unknown == 3) m.thickness_m += by;
    return m;
  };
  constexpr double kStep = 1e-6;
  std::size_t walls = 0, feet = 0;
  for (int y = 0; y < c.height; y += 3) {
    for (int x = 0; x < c.width; x += 3) {
      const auto distance = view.outline(model, x, y);
      if (!distance || std::abs(distance->px) > 3.0) continue;
      const auto depth = view.surface(model, x, y);
      const bool wall = depth->wall && distance->px > 0.5;
      walls += wall ? 1 : 0;
      feet += distance->gradient[3] > 0.0 ? 1 : 0;
      for (int k = 0; k < 4; ++k) {
        const RimModel more = changed(k, kStep), less = changed(k, -kStep);
        const double by_px =
            (view.outline(more, x, y)->px - view.outline(less, x, y)->px) / (2.0 * kStep);
        EXPECT_NEAR(distance->gradient[k], by_px, 0.02 * std::abs(by_px) + 12.0) << x << " " << y;
        if (!wall || k == 3) continue;
        const double by_m =
            (view.surface(more, x, y)->z_m - view.surface(less, x, y)->z_m) / (2.0 * kStep);
        EXPECT_NEAR(depth->gradient[k], by_m, 0.01 * std::abs(by_m) + 0.01) << x << " " << y;
      }
    }
  }
  EXPECT_GT(walls, 20u);
  EXPECT_GT(feet, 20u);
}

/// A plane that faces the sensor, with noise that is the mean over a square of independent values.
detection::ScanPixels noisy_plane(int reach) {
  detection::ScanPixels scan;
  scan.width = 120, scan.height = 100;
  const double scale = 1e-3 / (2.0 * reach + 1.0);
  for (int y = 0; y < scan.height; ++y) {
    for (int x = 0; x < scan.width; ++x) {
      double noise = 0.0;
      for (int v = y - reach; v <= y + reach; ++v)
        for (int u = x - reach; u <= x + reach; ++u)
          noise += standard_normal(hash_key(7, std::uint64_t(v + 9), std::uint64_t(u + 9)));
      scan.point.emplace_back(0.0f, 0.0f, float(1.0 + scale * noise));
    }
  }
  scan.still.assign(scan.point.size(), 1);
  return scan;
}

TEST(CorrelationOf, CountsPixelsThatAFilterJoinsAsOne) {
  CameraIntrinsics c = camera();
  c.width = 120, c.height = 100;
  const RayTable rays(c);
  for (const int reach : {0, 1}) {
    const detection::ScanPixels scan = noisy_plane(reach);
    std::vector<std::int32_t> pixels;
    for (std::size_t i = 0; i < scan.point.size(); ++i)
      pixels.push_back(static_cast<std::int32_t>(i));
    const auto noise = detection::correlation_of(scan, rays, Plane{-Vec3d::UnitZ(), -1.0}, pixels);
    EXPECT_EQ(noise.blur_px, reach);
    EXPECT_NEAR(noise.pixels_per_sample, reach == 0 ? 1.0 : 9.0, reach == 0 ? 0.4 : 1.5);
    EXPECT_NEAR(noise.sigma_m, 1e-3, 5e-5);
  }
}

}  // namespace
}  // namespace turnscan
