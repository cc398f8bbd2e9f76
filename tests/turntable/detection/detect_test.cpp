#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/depth/depth_bias.hpp>
#include <turnscan/turntable/detection/detect.hpp>

#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

AveragedScan scan_of(const testing::RigOptions& options) {
  const testing::Rig rig(options);
  auto scan = average_frames(rig, spread_positions(rig, 0, 100), {}, {});
  EXPECT_TRUE(scan);
  return std::move(*scan);
}

struct Errors {
  double axis_deg, center_mm, radius_mm;
};
Errors errors_of(const DetectedPlatter& p, const testing::RigOptions& options) {
  const TurntableInfo truth = testing::Rig(options).truth();
  return {std::acos(std::min(1.0, p.axis.dot(truth.axis))) * kDegrees,
          (p.center_m - truth.center_m).norm() * 1e3,
          std::abs(p.radius_m - options.radius_m) * 1e3};
}

// The full set of 50 rigs is bench/calibration_rigs.
TEST(DetectPlatter, FindsItInARoomWithClutter) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const std::uint64_t seed : {2, 8, 14}) {
    testing::RigOptions options = testing::random_rig(seed);
    options.frames = 8;
    const auto platter = detect_platter(scan_of(options), {}, {});
    ASSERT_TRUE(platter) << seed << ": " << platter.error().text();
    const Errors errors = errors_of(*platter, options);
    EXPECT_LT(errors.axis_deg, 0.15) << seed;
    EXPECT_LT(errors.center_mm, 2.0) << seed;
    EXPECT_LT(errors.radius_mm, 2.0) << seed;
    EXPECT_GT(platter->confidence, 0.8) << seed;
  }
}

TEST(DetectPlatter, FindsItUnderAnObjectInOneNoisyFrame) {
  testing::RigOptions options = testing::random_rig(11);
  options.frames = 1;
  options.objects = {*builtin_object("cylinder")};
  const auto platter = detect_platter(scan_of(options), {}, {});
  ASSERT_TRUE(platter) << platter.error().text();
  EXPECT_LT(errors_of(*platter, options).axis_deg, 0.15);
  EXPECT_LT(errors_of(*platter, options).center_mm, 3.0);
}

TEST(DetectPlatter, RefusesARoomWithoutOne) {
  testing::RigOptions options = testing::random_rig(3);
  options.frames = 4;
  options.platter = false;
  const auto platter = detect_platter(scan_of(options), {}, {});
  ASSERT_FALSE(platter);
  EXPECT_EQ(platter.error().code, ErrorCode::kMissingData);
}

TEST(DetectPlatter, RefusesOneOfAnotherRadiusThanGiven) {
  testing::RigOptions options = testing::random_rig(2);
  options.frames = 4;
  DetectOptions detect;
  detect.radius_m = 0.09;
  EXPECT_FALSE(detect_platter(scan_of(options), detect, {}));
}

TEST(DetectPlatter, IsTheSameForAnyNumberOfThreads) {
  testing::RigOptions options = testing::random_rig(5);
  options.frames = 2;
  const AveragedScan scan = scan_of(options);
  const auto many = detect_platter(scan, {}, {});
  set_thread_count(1);
  const auto one = detect_platter(scan, {}, {});
  set_thread_count(0);
  ASSERT_TRUE(many && one);
  EXPECT_EQ(many->center_m, one->center_m);
  EXPECT_EQ(many->axis, one->axis);
}

TEST(DetectPlatter, RefusesWrongOptionsAndCancelling) {
  testing::RigOptions options = testing::random_rig(5);
  options.frames = 1;
  const AveragedScan scan = scan_of(options);
  DetectOptions detect;
  detect.min_radius_m = 0.7;
  EXPECT_EQ(detect_platter(scan, detect, {}).error().code, ErrorCode::kInvalidOption);
  detect = {};
  detect.min_confidence = std::nan("");
  EXPECT_EQ(detect_platter(scan, detect, {}).error().code, ErrorCode::kInvalidOption);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(detect_platter(scan, {}, context).error().code, ErrorCode::kCancelled);
}

TEST(GaugeDepth, FindsWhatWasTakenOffTheDepth) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const double bias_m : {0.02, -0.03}) {
    testing::RigOptions options = testing::random_rig(5);
    options.frames = 4;
    const AveragedScan scan = shifted(scan_of(options), -bias_m);
    const auto found = gauge_depth(scan, options.radius_m, 0.001, {}, {});
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_NEAR(found->offset_m, 0.001 + bias_m, std::max(0.004, 2.5 * found->sigma_m));
    EXPECT_LT(found->sigma_m, 0.006);
  }
}

TEST(FitDepth, FindsOffsetAndScaleFromTwoDistances) {
  // True depth is 1.02 times the recorded one less 15 mm.
  std::vector<DepthGauge> gauges;
  for (const double distance_m : {0.8, 1.1}) {
    testing::RigOptions options = testing::random_rig(5);
    options.frames = 4;
    options.shrink = 2;
    options.distance_m = distance_m;
    AveragedScan scan = scan_of(options);
    for (float& z : scan.depth_m.pixels)
      if (z > 0.0f) z = float((z + 0.015) / 1.02);
    const auto gauge = gauge_depth(scan, options.radius_m, 0.0, {}, {});
    ASSERT_TRUE(gauge) << gauge.error().text();
    gauges.push_back(*gauge);
  }
  const auto found = fit_depth(gauges);
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_NEAR(found->scale, 1.02, std::max(0.006, 3.0 * found->scale_sigma));
  EXPECT_NEAR(found->bias_m, -0.015, std::max(0.006, 3.0 * found->bias_sigma_m));
  EXPECT_LT(found->scale_sigma, 0.04);
}

TEST(FitDepth, IsALineAndNeedsTwoDistances) {
  const auto found = fit_depth(
      std::vector<DepthGauge>{{0.5, 0.010, 0.001}, {1.0, 0.015, 0.002}, {2.0, 0.025, 0.001}});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->scale, 1.01, 1e-12);
  EXPECT_NEAR(found->bias_m, 0.005, 1e-12);
  EXPECT_EQ(fit_depth(std::vector<DepthGauge>{{1.0, 0.01, 0.001}}).error().code,
            ErrorCode::kTooFewPoints);
  EXPECT_EQ(
      fit_depth(std::vector<DepthGauge>{{1.0, 0.01, 0.001}, {1.01, 0.01, 0.001}}).error().code,
      ErrorCode::kTooFewPoints);
}

TEST(GaugeDepth, RefusesARadiusThatCannotBe) {
  testing::RigOptions options = testing::random_rig(5);
  options.frames = 1;
  const AveragedScan scan = scan_of(options);
  EXPECT_FALSE(gauge_depth(scan, 2.0 * options.radius_m, 0.0, {}, {}));
  EXPECT_EQ(gauge_depth(scan, std::nan(""), 0.0, {}, {}).error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
