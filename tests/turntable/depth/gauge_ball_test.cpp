#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/turntable/depth/gauge_ball.hpp>

#include "tests/support/rig.hpp"

namespace turnscan {
namespace {

/// A ball on the platter, as flat triangles whose middles lie as far inside as their corners
/// outside.
TriangleMesh ball_mesh(double radius_m, const Vec3d& center, int around = 200) {
  TriangleMesh mesh;
  const int rows = around / 2;
  const double r = radius_m * (1.0 + 0.5 * std::pow(std::numbers::pi / around, 2));
  for (int v = 0; v <= rows; ++v) {
    for (int u = 0; u < around; ++u) {
      const double a = 2.0 * std::numbers::pi * u / around, b = std::numbers::pi * v / rows;
      const Vec3d n(std::sin(b) * std::cos(a), std::cos(b), -std::sin(b) * std::sin(a));
      mesh.vertices.push_back((center + r * n).cast<float>());
    }
  }
  const auto index = [&](int v, int u) { return std::uint32_t(v * around + u % around); };
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < around; ++u) {
      mesh.triangles.push_back({index(v, u), index(v + 1, u), index(v + 1, u + 1)});
      mesh.triangles.push_back({index(v, u), index(v + 1, u + 1), index(v, u + 1)});
    }
  }
  return mesh;
}

testing::RigOptions rig_with_ball(std::uint64_t seed, double radius_m) {
  testing::RigOptions options = testing::random_rig(seed);
  options.clutter = 0;
  options.frames = 4;
  options.aim_height_m = radius_m;
  options.objects = {ball_mesh(radius_m, Vec3d(0.01, radius_m, -0.02))};
  return options;
}

AveragedScan scan_of(const testing::RigOptions& options) {
  const testing::Rig rig(options);
  auto scan = average_frames(rig, spread_positions(rig, 0, 100), {}, {});
  EXPECT_TRUE(scan);
  return std::move(*scan);
}

TEST(GaugeBall, FindsWhatWasTakenOffTheDepthWithinWhatItStates) {
  double squares = 0.0;
  int count = 0;
  for (const std::uint64_t seed : {1, 2}) {
    const double bias_m = seed % 2 == 0 ? 0.02 : -0.03;
    const AveragedScan scan = shifted(scan_of(rig_with_ball(seed, 0.09)), -bias_m);
    const auto found = gauge_depth_with_ball(scan, 0.18, 0.001, {});
    ASSERT_TRUE(found) << seed << ": " << found.error().text();
    const double error = found->gauge.offset_m - 0.001 - bias_m;
    EXPECT_LT(std::abs(error), std::max(0.002, 3.5 * found->gauge.sigma_m)) << seed;
    EXPECT_LT(found->gauge.sigma_m, 0.006) << seed;
    squares += std::pow(error / found->gauge.sigma_m, 2);
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 2.5);
  // The smaller the ball, the less it says.
  const auto small = gauge_depth_with_ball(scan_of(rig_with_ball(3, 0.04)), 0.08, 0.0, {});
  ASSERT_TRUE(small) << small.error().text();
  EXPECT_LT(std::abs(small->gauge.offset_m), 3.5 * small->gauge.sigma_m);
  EXPECT_GT(small->gauge.sigma_m, 3e-4);
}

// Noise that moves the normals with the points pulls a small ball by millimetres, always outwards.
TEST(GaugeBall, IsNotPulledByNoise) {
  double sum = 0.0, stated = 0.0;
  for (const std::uint64_t seed : {2, 3, 5}) {
    testing::RigOptions options = rig_with_ball(seed, 0.04);
    options.noise_m = 0.003;
    options.distance_m = 0.7;
    const auto found = gauge_depth_with_ball(scan_of(options), 0.08, 0.0, {});
    ASSERT_TRUE(found) << seed << ": " << found.error().text();
    sum += found->gauge.offset_m;
    stated += std::pow(found->gauge.sigma_m, 2);
  }
  EXPECT_LT(std::abs(sum), 2.0 * std::sqrt(stated));
  EXPECT_LT(std::abs(sum / 3.0), 0.0025);
  EXPECT_LT(std::sqrt(stated / 3.0), 0.004);
}

TEST(GaugeBall, RefusesWhatIsNoBallAndTwoOfThem) {
  testing::RigOptions empty = testing::random_rig(2);
  empty.frames = 4;
  const auto none = gauge_depth_with_ball(scan_of(empty), 0.18, 0.0, {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kMissingData);
  // A ball of another size than stated.
  const AveragedScan scan = scan_of(rig_with_ball(3, 0.09));
  EXPECT_FALSE(gauge_depth_with_ball(scan, 0.30, 0.0, {}));
  EXPECT_FALSE(gauge_depth_with_ball(scan, 0.08, 0.0, {}));
  testing::RigOptions two = rig_with_ball(2, 0.05);
  two.objects = {ball_mesh(0.05, Vec3d(0.07, 0.05, 0.0)), ball_mesh(0.05, Vec3d(-0.07, 0.05, 0.0))};
  two.distance_m = 0.7;
  const auto both = gauge_depth_with_ball(scan_of(two), 0.10, 0.0, {});
  ASSERT_FALSE(both);
  EXPECT_NE(both.error().message.find("two balls"), std::string::npos) << both.error().message;
}

TEST(GaugeBall, RefusesWrongDiametersAndCancelling) {
  const AveragedScan scan = scan_of(rig_with_ball(2, 0.09));
  for (const double diameter : {0.0, -0.1, 2.0, std::nan("")})
    EXPECT_EQ(gauge_depth_with_ball(scan, diameter, 0.0, {}).error().code,
              ErrorCode::kInvalidOption);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(gauge_depth_with_ball(scan, 0.18, 0.0, context).error().code, ErrorCode::kCancelled);
  BallOptions options;
  options.diameter_m = 5.0;
  EXPECT_EQ(describe(options).check().error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
