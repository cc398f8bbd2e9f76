#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

/// The doll on its platter.
testing::Rig rig_of_clouds(int count) {
  testing::RigOptions o;
  o.shrink = 2;
  o.room = false;
  o.mixed_pixels = 0.0;
  o.noise_m = 0.0002;
  o.distance_m = 0.6;
  o.elevation_rad = 0.35;
  o.aim_height_m = 0.09;
  o.frames = count;
  o.fps = 1.0;
  o.angle = [count](double t) { return kTurn / count * t; };
  o.objects = {*builtin_object("doll")};
  return testing::Rig(o);
}

/// What a scanner at the origin sees, with other axes than a camera's. told: the sign with which
/// the angles are written down.
testing::MemorySequence clouds_with_axes(const testing::Rig& rig,
                                         const Eigen::Matrix3d& scan_from_camera, double told) {
  testing::MemorySequence out;
  SensorInfo scanner;
  scanner.kind = SensorKind::kPointScanner;
  out.header_value.sensors = {scanner};
  const SensorInfo& camera = rig.header().sensors.front();
  const auto count = double(rig.frames().size());
  for (std::size_t i = 0; i < rig.frames().size(); ++i) {
    const auto points = points_of(*rig.read(i), camera, RayTable(camera.intrinsics));
    Frame scan;
    scan.info.index = std::uint32_t(i);
    scan.info.angle_rad = told * kTurn / count * double(i);
    for (const Vec3f& p : points->cloud.points)
      scan.points.points.push_back((scan_from_camera * p.cast<double>()).cast<float>());
    out.add(std::move(scan));
  }
  return out;
}

struct RangeScans {
  testing::MemorySequence sequence;
  TurntableInfo truth;  ///< in the frame of the scans
};

/// Scans of the doll `step_deg` apart on a table that is not seen: x right, y up, the origin near
/// the object, where no scanner stands. told: the sign with which the angles are written down.
RangeScans range_scans(int count, double step_deg, double told) {
  testing::RigOptions o;
  o.shrink = 2;
  o.platter = o.room = false;
  o.mixed_pixels = 0.0;
  o.noise_m = 0.0002;
  o.distance_m = 0.6;
  o.elevation_rad = 0.35;
  o.aim_height_m = 0.09;
  o.frames = count;
  o.fps = 1.0;
  const double step = step_deg * kRadiansPerDegree;
  o.angle = [step](double t) { return step * t; };
  o.objects = {*builtin_object("doll")};
  const testing::Rig rig(o);
  // Half a turn about the camera's x axis, and the origin beside the object.
  Pose T_scan_camera = Pose::Identity();
  T_scan_camera.linear() = Vec3d(1.0, -1.0, -1.0).asDiagonal();
  T_scan_camera.translation() = Vec3d(0.01, 0.02, o.distance_m);
  RangeScans out;
  SensorInfo sensor;
  sensor.kind = SensorKind::kPointScanner;
  out.sequence.header_value.sensors = {sensor};
  const SensorInfo& camera = rig.header().sensors.front();
  for (std::size_t i = 0; i < rig.frames().size(); ++i) {
    const auto points = points_of(*rig.read(i), camera, RayTable(camera.intrinsics));
    Frame scan;
    scan.info.index = i;
    scan.info.time_s = std::nan("");
    scan.info.angle_rad = told * step * double(i);
    for (const Vec3f& p : points->cloud.points)
      scan.points.points.push_back((T_scan_camera * p.cast<double>()).cast<float>());
    out.sequence.add(std::move(scan));
  }
  out.truth.axis = T_scan_camera.linear() * rig.truth().axis;
  out.truth.center_m = T_scan_camera * rig.truth().center_m;
  return out;
}

double axis_error_deg(const TurntableInfo& found, const TurntableInfo& truth) {
  return std::atan2(truth.axis.cross(found.axis).norm(), truth.axis.dot(found.axis)) *
         kDegreesPerRadian;
}

double line_error_mm(const TurntableInfo& found, const TurntableInfo& truth) {
  const Vec3d off = found.center_m - truth.center_m;
  return (off - off.dot(truth.axis) * truth.axis).norm() * 1e3;
}

TEST(RangeScans, FarApartAreAlignedWithAnglesOfEitherSign) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const double told : {1.0, -1.0}) {
    const RangeScans scans = range_scans(8, 45.0, told);
    const auto found = calibrate_from_motion(scans.sequence, {}, {}, {});
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_LT(axis_error_deg(found->table, scans.truth), 0.1);
    EXPECT_LT(line_error_mm(found->table, scans.truth), 0.3);
    for (std::size_t i = 0; i < found->angles_rad.size(); ++i)
      EXPECT_NEAR(found->angles_rad[i], 45.0 * kRadiansPerDegree * double(i), 0.01);
  }
}

TEST(RangeScans, AreAlignedTheSameWayForAnyNumberOfThreads) {
  const RangeScans scans = range_scans(6, 24.0, -1.0);
  const auto many = calibrate_from_motion(scans.sequence, {}, {}, {});
  set_thread_count(1);
  const auto one = calibrate_from_motion(scans.sequence, {}, {}, {});
  set_thread_count(0);
  ASSERT_TRUE(many && one);
  EXPECT_EQ(many->table.axis, one->table.axis);
  EXPECT_EQ(many->table.center_m, one->table.center_m);
  EXPECT_LT(axis_error_deg(many->table, scans.truth), 0.1);
}

TEST(RangeScans, StandOnTheirPlatterWhateverTheirAxes) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig rig = rig_of_clouds(12);
  Eigen::Matrix3d z_up;
  z_up << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  struct Convention {
    Eigen::Matrix3d axes;
    double told;
    std::string text;
  };
  for (const auto& [axes, told, text] :
       {Convention{Eigen::Matrix3d::Identity(), 1.0, "the clouds are y down, as PCL"},
        Convention{Vec3d(1.0, -1.0, -1.0).asDiagonal(), -1.0, "the clouds are y up, as OpenGL"},
        Convention{z_up, -1.0, "the clouds are z up"}}) {
    const auto found = calibrate_from_motion(clouds_with_axes(rig, axes, told), {}, {}, {});
    ASSERT_TRUE(found) << text << ": " << found.error().text();
    TurntableInfo truth = rig.truth();
    truth.axis = axes * truth.axis;
    truth.center_m = axes * truth.center_m;
    EXPECT_LT(axis_error_deg(found->table, truth), 0.1) << text;
    EXPECT_LT((found->table.center_m - truth.center_m).norm(), 0.001) << text;
    ASSERT_TRUE(found->table.radius_m) << text;
    EXPECT_NEAR(*found->table.radius_m, *truth.radius_m, 0.003) << text;
    EXPECT_TRUE(found->notes.back().starts_with(text)) << found->notes.back();
    EXPECT_GT(found->angles_rad[1], 0.0);
  }
}

TEST(RangeScans, ThatMayBeMirroredAreAskedAbout) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig rig = rig_of_clouds(12);
  Eigen::Matrix3d fru;
  fru << 0, 0, 1, 1, 0, 0, 0, -1, 0;
  for (const auto& [axes, told, ways] :
       {std::tuple{Eigen::Matrix3d(Vec3d(1.0, -1.0, 1.0).asDiagonal()), 1.0, "luf or --axes ruf"},
        std::tuple{Eigen::Matrix3d(Vec3d(1.0, -1.0, 1.0).asDiagonal()), -1.0, "luf or --axes ruf"},
        std::tuple{Eigen::Matrix3d(Vec3d(-1.0, -1.0, 1.0).asDiagonal()), 1.0, "luf or --axes ruf"},
        std::tuple{fru, -1.0, "flu or --axes fru"}}) {
    const auto found = calibrate_from_motion(clouds_with_axes(rig, axes, told), {}, {}, {});
    ASSERT_FALSE(found) << ways;
    EXPECT_EQ(found.error().code, ErrorCode::kInvalidOption);
    EXPECT_NE(found.error().message.find(ways), std::string::npos) << found.error().message;
  }
}

TEST(RangeScans, AreNotAlignedOnceCancelled) {
  const RunContext context;
  context.cancel();
  EXPECT_EQ(calibrate_from_motion(range_scans(4, 30.0, 1.0).sequence, {}, {}, context).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
