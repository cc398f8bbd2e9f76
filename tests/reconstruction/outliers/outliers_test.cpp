// The filter's contract: the kept set of its definition, options, errors, the same result
// everywhere.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/outliers/outliers.hpp>

#include "tests/reconstruction/outliers/depth_frames.hpp"
#include "tests/reconstruction/outliers/plain_outliers.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan::outliers {
namespace {

using testing::Defects;
using ::testing::HasSubstr;
using testing::NamedFrame;

OutlierOptions options(int k = 10, double lambda = 1.0) { return {true, k, lambda}; }

std::vector<std::uint8_t> mask(std::span<const Vec3f> points, const OutlierOptions& o = options()) {
  return statistical_outlier_mask(points, o).value();
}

std::vector<std::uint8_t> mask(const FramePoints& frame, const OutlierOptions& o = options()) {
  return mask(frame.cloud.points, o);
}

std::size_t dropped(const std::vector<std::uint8_t>& mask) {
  return std::size_t(std::count(mask.begin(), mask.end(), 0));
}

void expect_plain(std::span<const Vec3f> points, int k = 10, double lambda = 1.0) {
  EXPECT_EQ(mask(points, options(k, lambda)), testing::plain_outlier_mask(points, k, lambda))
      << "k " << k << ", lambda " << lambda;
}

void expect_plain(const FramePoints& frame, int k = 10, double lambda = 1.0) {
  expect_plain(frame.cloud.points, k, lambda);
}

/// As many points from the middle of a frame as the definition can be asked for.
std::span<const Vec3f> middle(const FramePoints& frame) {
  const std::span<const Vec3f> points(frame.cloud.points);
  constexpr std::size_t kPoints = 10000;
  return points.size() <= kPoints ? points : points.subspan((points.size() - kPoints) / 2, kPoints);
}

CameraIntrinsics small_camera(int width, int height, double f = 100.0) {
  CameraIntrinsics camera;
  camera.width = width, camera.height = height;
  camera.fx = camera.fy = f;
  camera.cx = width / 2.0, camera.cy = height / 2.0;
  return camera;
}

// --- the kept set -------------------------------------------------------------------------------

TEST(OutliersLikeThePlainFilter, ObjectWithNoiseHolesAndFlyingPixels) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Defects defects;
    defects.seed = seed;
    const FramePoints frame = testing::object_frame(testing::kinect_v2(), defects);
    ASSERT_GT(frame.cloud.size(), 5000u);
    expect_plain(frame);
    EXPECT_GT(dropped(mask(frame)), 50u);
  }
}

TEST(OutliersLikeThePlainFilter, FullFrameOfARoom) {
  expect_plain(testing::room_frame(small_camera(128, 106, 91.0)));
}

TEST(OutliersLikeThePlainFilter, AnyNumberOfNeighbours) {
  const FramePoints frame = testing::object_frame(small_camera(200, 160, 180.0));
  ASSERT_GT(frame.cloud.size(), 1001u);
  for (const int k : {1, 2, 4, 9, 11, 50, 250, 1000}) expect_plain(frame, k);
}

TEST(OutliersLikeThePlainFilter, AnyLambda) {
  const FramePoints frame = testing::object_frame(testing::kinect_v2());
  for (const double lambda : {0.0, 0.1, 0.5, 2.0, 3.7, 100.0}) expect_plain(frame, 10, lambda);
}

TEST(OutliersLikeThePlainFilter, FrontalPlaneWhereNearlyAllDistancesTie) {
  const FramePoints frame =
      testing::render(small_camera(90, 70), [](int, int, double, double) { return 1.0; });
  for (const int k : {1, 4, 8, 10, 12, 24}) expect_plain(frame, k);
}

TEST(OutliersLikeThePlainFilter, NoiseOfSeveralPixelSpacings) {
  for (const double noise : {0.0, 0.0001, 0.01, 0.05}) {
    Defects defects;
    defects.noise_m = noise;
    defects.holes = 0.3;
    expect_plain(testing::object_frame(testing::kinect_v2(), defects));
  }
}

TEST(OutliersLikeThePlainFilter, PixelsOfRandomDepth) {
  const auto random = [](int column, int row, double, double) {
    return 0.3 + 4.0 * uniform01(hash_key(7, std::uint64_t(column), std::uint64_t(row)));
  };
  for (const int k : {1, 10, 30}) expect_plain(testing::render(small_camera(120, 90), random), k);
}

TEST(OutliersLikeThePlainFilter, MostPixelsEmpty) {
  for (const double holes : {0.9, 0.99}) {
    Defects defects;
    defects.holes = holes;
    expect_plain(testing::room_frame(testing::kinect_v2(), defects));
  }
}

TEST(OutliersLikeThePlainFilter, StepsSeenAlmostEdgeOn) {
  const auto stairs = [](int column, int row, double x, double) {
    return column % 9 < 2 ? 2.0 + 0.3 * (row % 5) : 0.5 / (1.0 - 1.9 * x);
  };
  expect_plain(testing::render(small_camera(100, 60), stairs));
}

TEST(OutliersLikeThePlainFilter, SingleRowsAndColumns) {
  const auto slope = [](int column, int row, double, double) {
    return 1.0 + 0.001 * ((column * 7 + row * 5) % 11);
  };
  for (const auto& [width, height] : {std::pair(200, 1), std::pair(1, 200), std::pair(12, 1)})
    expect_plain(testing::render(small_camera(width, height), slope));
}

TEST(OutliersLikeThePlainFilter, FewPoints) {
  const auto slope = [](int column, int row, double, double) {
    return 1.0 + 0.01 * ((column * 7 + row * 3) % 5);
  };
  for (int count = 1; count <= 24; ++count)
    for (const int k : {1, 5, 10, 20})
      expect_plain(testing::render(small_camera(count, 1), slope), k);
}

TEST(OutliersLikeThePlainFilter, TheSamePointSeveralTimes) {
  FramePoints frame = testing::object_frame(testing::kinect_v2());
  for (std::size_t i = 0; i + 40 < frame.cloud.size(); i += 40)
    for (std::size_t j = 1; j < 1 + i % 17; ++j) frame.cloud.points[i + j] = frame.cloud.points[i];
  expect_plain(frame);
}

TEST(OutliersLikeThePlainFilter, AllPointsInOnePlace) {
  FramePoints frame =
      testing::render(small_camera(30, 20), [](int, int, double, double) { return 1.0; });
  for (Vec3f& p : frame.cloud.points) p = Vec3f(0.25f, 0.5f, 1.0f);
  expect_plain(frame);
}

TEST(Outliers, ManyPointsInOnePlaceAreNotSearchedOneByOne) {
  FramePoints frame = testing::object_frame(testing::kinect_v2());
  frame.cloud.points.resize(frame.cloud.size() + 200000, Vec3f::Zero());
  const std::vector<std::uint8_t> kept = mask(frame);
  EXPECT_EQ(std::count(kept.end() - 200000, kept.end(), 1), 200000);
  EXPECT_GT(dropped(kept), 50u);
}

TEST(OutliersLikeThePlainFilter, PointsInAnyOrder) {
  expect_plain(testing::shuffled(testing::object_frame(testing::kinect_v2()), 3));
}

TEST(OutliersLikeThePlainFilter, RealDepthImages) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const std::vector<NamedFrame> frames = testing::real_depth_frames(25);
  if (frames.empty()) GTEST_SKIP() << "no data sets (TURNSCAN_TEST_DATA)";
  for (const NamedFrame& frame : frames) {
    SCOPED_TRACE(frame.name);
    ASSERT_GT(frame.points.cloud.size(), 1000u);
    expect_plain(middle(frame.points));
  }
}

TEST(OutliersLikeThePlainFilter, RealRangeScans) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const std::vector<NamedFrame> scans = testing::real_range_scans();
  if (scans.empty()) GTEST_SKIP() << "no data sets (TURNSCAN_TEST_DATA)";
  for (const NamedFrame& scan : scans) {
    SCOPED_TRACE(scan.name);
    ASSERT_GT(scan.points.cloud.size(), 1000u);
    expect_plain(middle(scan.points));
  }
}

// --- what else is promised ----------------------------------------------------------------------

TEST(Outliers, DropsThePointFarFromAllOthers) {
  FramePoints frame = testing::render(
      small_camera(40, 30),
      [](int column, int row, double, double) { return column == 20 && row == 15 ? 1.2 : 1.0; });
  const std::vector<std::uint8_t> kept = mask(frame, options(10, 5.0));
  EXPECT_EQ(dropped(kept), 1u);
  EXPECT_EQ(kept[15 * 40 + 20], 0);
}

TEST(Outliers, TheThresholdIsThatOfTheMeanDistances) {
  // Four points on a line at 0, 1, 3, 6; nearest neighbours at 1, 1, 2, 3: mean 1.75, sd 0.957.
  const std::vector<Vec3f> line = {{0, 0, 1}, {1, 0, 1}, {3, 0, 1}, {6, 0, 1}};
  EXPECT_EQ(mask(line, options(1, 1.305)), (std::vector<std::uint8_t>{1, 1, 1, 0}));
  EXPECT_EQ(mask(line, options(1, 1.307)), (std::vector<std::uint8_t>{1, 1, 1, 1}));
}

TEST(Outliers, SwitchedOffKeepsEverything) {
  const FramePoints frame = testing::object_frame(testing::kinect_v2());
  EXPECT_EQ(dropped(mask(frame, {false, 10, 1.0})), 0u);
}

TEST(Outliers, NoPointsGiveAnEmptyMask) { EXPECT_TRUE(mask(FramePoints()).empty()); }

TEST(Outliers, TheSameMaskForAnyNumberOfThreads) {
  const FramePoints frame = testing::room_frame(testing::kinect_v2());
  set_thread_count(1);
  const auto serial = mask(frame);
  set_thread_count(2);
  EXPECT_EQ(mask(frame), serial);
  set_thread_count(0);
  EXPECT_EQ(mask(frame), serial);
}

TEST(Outliers, ManyFramesAtOnceAreEachFilteredAsAlone) {
  std::vector<FramePoints> frames;
  std::vector<std::vector<std::uint8_t>> alone;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Defects defects;
    defects.seed = seed;
    const CameraIntrinsics camera = small_camera(160 + 7 * int(seed % 5), 120, 140.0);
    frames.push_back(seed % 2 ? testing::room_frame(camera, defects)
                              : testing::object_frame(camera, defects));
    alone.push_back(mask(frames.back()));
  }
  std::vector<std::vector<std::uint8_t>> together(frames.size());
  set_thread_count(4);
  parallel_for(frames.size(), 1, [&](std::size_t i) { together[i] = mask(frames[i]); });
  set_thread_count(0);
  EXPECT_EQ(together, alone);
}

TEST(Outliers, CancelledRunSaysSo) {
  const RunContext context;
  context.cancel();
  const FramePoints frame = testing::object_frame(testing::kinect_v2());
  const auto result = statistical_outlier_mask(frame.cloud.points, options(), context);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
}

// --- bad input ----------------------------------------------------------------------------------

void expect_refused(const OutlierOptions& o, const std::string& field) {
  const std::vector<Vec3f> points(20, Vec3f(0, 0, 1));
  const auto result = statistical_outlier_mask(points, o);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidOption);
  EXPECT_THAT(result.error().message, HasSubstr(field));
}

TEST(OutlierOptions, NeighboursAreFrom1To1000) {
  expect_refused(options(0), "outlier-k");
  expect_refused(options(-3), "outlier-k");
  expect_refused(options(1001), "outlier-k");
}

TEST(OutlierOptions, LambdaIsFrom0To100) {
  expect_refused(options(10, -0.1), "outlier-lambda");
  expect_refused(options(10, 100.1), "outlier-lambda");
}

TEST(OutlierOptions, LambdaIsANumber) {
  expect_refused(options(10, std::numeric_limits<double>::quiet_NaN()), "outlier-lambda");
}

TEST(OutlierOptions, AreSetByName) {
  OutlierOptions o;
  const OptionTable table = describe(o);
  ASSERT_TRUE(table.set("outliers", "false"));
  ASSERT_TRUE(table.set("outlier-k", "25"));
  ASSERT_TRUE(table.set("outlier-lambda", "2.5"));
  EXPECT_FALSE(o.enabled);
  EXPECT_EQ(o.neighbours, 25);
  EXPECT_EQ(o.lambda, 2.5);
}

TEST(Outliers, CoordinatesThatAreNotFiniteAreRefused) {
  for (const float bad : {NAN, INFINITY, -INFINITY, 2e9f}) {
    for (int axis = 0; axis < 3; ++axis) {
      FramePoints frame = testing::object_frame(testing::kinect_v2());
      frame.cloud.points[17][axis] = bad;
      const auto result = statistical_outlier_mask(frame.cloud.points, options());
      ASSERT_FALSE(result);
      EXPECT_EQ(result.error().code, ErrorCode::kFormat);
      EXPECT_THAT(result.error().message, HasSubstr("point 17"));
    }
  }
}

}  // namespace
}  // namespace turnscan::outliers
