#include <gtest/gtest.h>

#include <map>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/table_frame.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/rig.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

testing::RigOptions rig_options(const std::string& object, int frames, double turns) {
  static std::map<std::string, TriangleMesh> meshes;
  if (meshes.count(object) == 0) meshes[object] = *builtin_object(object);
  testing::RigOptions o;
  o.shrink = 2;
  o.noise_m = 0.001;
  o.distance_m = 0.6;
  o.elevation_rad = 0.45;
  o.roll_rad = 0.08;
  o.aim_height_m = 0.07;
  o.clutter = 3;
  o.frames = frames;
  o.fps = frames / 30.0;
  o.objects = {meshes[object]};
  const double speed = turns * 2.0 * std::numbers::pi / 30.0;
  o.angle = [speed](double t) { return speed * t; };
  return o;
}

double axis_error_deg(const testing::Rig& rig, const Calibration& c) {
  const Vec3d axis = rig.truth().axis;
  return std::atan2(axis.cross(c.table.axis).norm(), axis.dot(c.table.axis)) * kDegreesPerRadian;
}

/// Distance of the centre from the true axis.
double line_error_mm(const testing::Rig& rig, const Calibration& c) {
  const Vec3d off = c.table.center_m - rig.truth().center_m, axis = rig.truth().axis;
  return (off - off.dot(axis) * axis).norm() * 1e3;
}

double mean_angle_error_deg(const testing::Rig& rig, const Calibration& c) {
  double sum = 0.0;
  for (std::size_t i = 0; i < c.angles_rad.size(); ++i)
    sum += std::abs(c.angles_rad[i] - rig.true_angle(i)) / double(c.angles_rad.size());
  return sum * kDegreesPerRadian;
}

// The full set is bench/calibration_motion.
TEST(CalibrateFromMotion, FindsAxisSpeedAndSignWithoutAHint) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  for (const double turns : {1.1, -1.1}) {
    const testing::Rig rig(rig_options("doll", turns > 0 ? 60 : 40, turns));
    const auto found = calibrate_from_motion(rig, {}, {}, {});
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_LT(axis_error_deg(rig, *found), 0.1);
    EXPECT_LT(line_error_mm(rig, *found), 0.3);
    EXPECT_NEAR(*found->table.speed_rad_s, turns * 2.0 * std::numbers::pi / 30.0,
                0.003 * 2.0 * std::numbers::pi / 30.0);
    EXPECT_LT(mean_angle_error_deg(rig, *found), 0.4);
    EXPECT_TRUE(found->undetermined.empty());
  }
}

TEST(CalibrateFromMotion, FollowsASlowStart) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 90, 1.1);
  const double speed = 1.1 * 2.0 * std::numbers::pi / 30.0;
  o.angle = [speed](double t) {
    t -= 2.0;
    return t <= 0.0 ? 0.0 : t < 3.0 ? speed * t * t / 6.0 : speed * (t - 1.5);
  };
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_LT(mean_angle_error_deg(rig, *found), 0.8);
  EXPECT_NEAR(*found->start_s, 3.5, 0.2);  // where the steady line meets the start
}

/// A wheel with teeth that are about a pixel wide.
TriangleMesh gear(int teeth, double radius_m, double depth_m, double height_m) {
  TriangleMesh mesh;
  const std::uint32_t n = 4 * std::uint32_t(teeth);
  for (std::uint32_t i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / n;
    const double r = radius_m - (i % 4 < 2 ? 0.0 : depth_m);
    for (const double y : {0.0, height_m})
      mesh.vertices.emplace_back(float(r * std::cos(angle)), float(y), float(-r * std::sin(angle)));
  }
  mesh.vertices.emplace_back(0.0F, 0.0F, 0.0F);
  mesh.vertices.emplace_back(0.0F, float(height_m), 0.0F);
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
    mesh.triangles.push_back({a, b, b + 1});
    mesh.triangles.push_back({a, b + 1, a + 1});
    mesh.triangles.push_back({2 * n, b, a});
    mesh.triangles.push_back({2 * n + 1, a + 1, b + 1});
  }
  return mesh;
}

// Their gaps are hidden at a slant: all pairs of frames fit as if the axis lay farther away.
TEST(CalibrateFromMotion, StatesHowFarFineTeethMayHaveMovedTheAxis) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 48, 1.1);
  o.objects = {gear(60, 0.065, 0.004, 0.04)};
  o.shrink = 1;
  o.distance_m = 0.9;
  o.elevation_rad = 0.3;
  o.aim_height_m = 0.02;
  o.room = o.drum = false;
  o.clutter = 0;
  const testing::Rig rig(o);
  FromMotionOptions options;
  options.speed_rad_s = 1.1 * 2.0 * std::numbers::pi / 30.0;
  const auto found = calibrate_from_motion(rig, options, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_LT(line_error_mm(rig, *found), 2.0e3 * found->center_sigma_m);
  EXPECT_LT(line_error_mm(rig, *found), 2.0);
}

// Outlines tell the axis, and so do surfaces that are seen at low angles.
TEST(CalibrateFromMotion, FindsTheAxisWithoutAPlatter) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 48, 1.1);
  o.shrink = 1;
  o.distance_m = 0.9;
  o.platter = false;
  o.seed = 2;
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_LT(axis_error_deg(rig, *found), 0.1);
  EXPECT_LT(line_error_mm(rig, *found), 0.15);
  EXPECT_LT(found->axis_sigma_rad, 0.15 * kRadiansPerDegree);
  const double height_m = rig.truth().axis.dot(found->table.center_m - rig.truth().center_m);
  EXPECT_LT(std::abs(height_m), 0.004);
  // Nothing is seen below it: a base that is hidden from above leaves a share of its reach open.
  EXPECT_GT(found->height_sigma_m, 0.03 * *found->table.reach_m);
  EXPECT_FALSE(found->table.radius_m);
  ASSERT_TRUE(found->table.reach_m);
  EXPECT_NEAR(*found->table.reach_m, 0.09, 0.015);
}

// An object that reaches beyond its platter is not seen whole above it, so where it ends proves
// nothing.
TEST(CalibrateFromMotion, SeesThePlatterBesideAnObjectThatFillsTheImage) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  auto options = rig_options("doll", 24, 1.2);
  options.room = options.drum = false;
  options.clutter = 0;
  options.shrink = 1;
  options.radius_m = 0.11;
  for (TriangleMesh& mesh : options.objects)
    for (Vec3f& p : mesh.vertices) p *= 1.6f;
  const testing::Rig rig(options);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_TRUE(found->table.radius_m);
  EXPECT_NEAR(*found->table.radius_m, 0.11, 0.002);
  EXPECT_LT((found->table.center_m - rig.truth().center_m).norm(), 0.002);
}

TEST(CalibrateFromMotion, KeepsTheRecordingsHeightWhereTheObjectEndsElsewhere) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 40, 1.1);
  o.platter = false;
  const testing::Rig rig(o);
  SequenceHeader header = rig.header();
  header.turntable = rig.truth();
  header.turntable->radius_m = 0.045;
  header.turntable->center_m -= 0.02 * header.turntable->axis;
  SequenceView sequence(rig);
  sequence.set_header(header);
  const auto found = calibrate_from_motion(sequence, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const double height_m = rig.truth().axis.dot(found->table.center_m - rig.truth().center_m);
  EXPECT_NEAR(height_m, -0.02, 0.002);
  EXPECT_EQ(found->height_found, "the recording's");
  EXPECT_GE(found->height_sigma_m, 0.01);
  EXPECT_EQ(found->undetermined, std::vector<std::string>{"height"});
  EXPECT_EQ(found->table.radius_m, 0.045);
  EXPECT_FALSE(found->table.reach_m);
}

TEST(CalibrateFromMotion, TellsTheMotorsSpeedBesideASlip) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 60, 1.1);
  const double speed = 1.1 * 2.0 * std::numbers::pi / 30.0;
  o.angle = [speed](double t) { return speed * t + (t < 16.2 ? 0.0 : 12.0 * kRadiansPerDegree); };
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_NEAR(*found->table.speed_rad_s, speed, 0.003 * speed);
  EXPECT_LT(mean_angle_error_deg(rig, *found), 0.4);
}

// Fast turns, whose speed may change much from frame to frame, swallowed it.
TEST(CalibrateFromMotion, ASlipIsOneStepBetweenTwoFramesOfAnEvenTurn) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 60, 1.1);
  o.fps = 5.0;
  o.noise_m = 0.003;
  const double speed = 1.1 * 2.0 * std::numbers::pi / 12.0, slip = -9.0 * kRadiansPerDegree;
  o.angle = [=](double t) { return speed * t + (t < 6.5 ? 0.0 : slip); };
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_EQ(found->slips.size(), 1u);
  EXPECT_EQ(rig.frames()[found->slips[0].first_frame].time_s, 6.6);
  EXPECT_NEAR(found->slips[0].turn_rad, slip, 0.5 * kRadiansPerDegree);
  EXPECT_LT(std::abs(*found->table.speed_rad_s - speed), 3.0 * found->speed_sigma_rad_s);
  EXPECT_LT(mean_angle_error_deg(rig, *found), 0.15);
}

/// Of the angles, each over what is stated of it, beside a turn that all share.
double angle_errors_over_stated(const testing::Rig& rig, const Calibration& c) {
  double shared = 0.0, weights = 0.0, squares = 0.0;
  for (std::size_t i = 1; i < c.angles_rad.size(); ++i) {
    const double weight = 1.0 / (c.angle_sigma_rad[i] * c.angle_sigma_rad[i]);
    shared += weight * (c.angles_rad[i] - rig.true_angle(i)), weights += weight;
  }
  for (std::size_t i = 1; i < c.angles_rad.size(); ++i)
    squares += std::pow(
        (c.angles_rad[i] - rig.true_angle(i) - shared / weights) / c.angle_sigma_rad[i], 2);
  return std::sqrt(squares / double(c.angles_rad.size() - 1));
}

TEST(CalibrateFromMotion, SaysWhereNoSurfaceJoinsTheViewsBeforeASlipToThoseAfterIt) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("letter-a", 60, 0.95);
  o.fps = 5.0;
  const double speed = 0.95 * 2.0 * std::numbers::pi / 12.0, slip = 40.0 * kRadiansPerDegree;
  // It is seen edge on then.
  o.angle = [=](double t) { return speed * t + (t < 8.4 ? 0.0 : slip); };
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_EQ(found->undetermined, std::vector<std::string>{"angles"});
  EXPECT_LT(angle_errors_over_stated(rig, *found), 2.0);
  EXPECT_EQ(found->notes.size(), 1u);
}

TEST(CalibrateFromMotion, FollowsAHaltOfAFastTurn) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 60, 1.1);
  o.fps = 5.0;
  o.noise_m = 0.003;
  const double speed = 1.1 * 2.0 * std::numbers::pi / 12.0;
  o.angle = [=](double t) { return speed * (t - std::clamp(t - 5.1, 0.0, 0.8)); };
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_TRUE(found->slips.empty());
  EXPECT_NEAR(*found->table.speed_rad_s, speed, 0.01 * speed);
  EXPECT_LT(std::abs(*found->table.speed_rad_s - speed), 3.0 * found->speed_sigma_rad_s);
  EXPECT_LT(mean_angle_error_deg(rig, *found), 0.15);
}

TEST(CalibrateFromMotion, TheSpeedOfAnUnevenMotorIsItsMeanAndStatedByItsScatter) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 60, 1.1);
  const double slow = 1.0 * 2.0 * std::numbers::pi / 30.0;
  const auto fast_s = [](double t) {  // in the first 6 and the last 7 seconds
    return std::clamp(t, 0.0, 6.0) + std::clamp(t - 23.0, 0.0, 7.0);
  };
  o.angle = [=](double t) { return slow * (t + 0.35 * fast_s(t)); };
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const double mean = o.angle(29.5) / 29.5;
  EXPECT_NEAR(*found->table.speed_rad_s, mean, 0.03 * mean);
  EXPECT_GT(found->speed_sigma_rad_s, 0.01 * mean);
  EXPECT_TRUE(found->slips.empty());
}

// Pairs of views alone lead each other astray, here to 0.12 degrees; the model does not.
TEST(CalibrateFromMotion, FollowsTheRippleOfAMotor) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  testing::RigOptions o = rig_options("doll", 120, 1.1);
  const double speed = 1.1 * 2.0 * std::numbers::pi / 30.0;
  o.angle = [speed](double t) { return speed * t + 0.01 * std::sin(speed * t); };
  const testing::Rig rig(o);
  const auto found = calibrate_from_motion(rig, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_LT(mean_angle_error_deg(rig, *found), 0.08);
  EXPECT_TRUE(found->slips.empty());
  double squares = 0.0;  // errors in units of what is stated
  for (std::size_t i = 1; i < found->angles_rad.size(); ++i)
    squares += std::pow((found->angles_rad[i] - rig.true_angle(i)) / found->angle_sigma_rad[i], 2);
  EXPECT_LT(std::sqrt(squares / double(found->angles_rad.size() - 1)), 2.5);
}

TEST(CalibrateFromMotion, LeavesARoundObjectsAnglesToTheStatedSpeedAndSaysSo) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const testing::Rig rig(rig_options("cylinder", 40, 1.1));
  EXPECT_EQ(calibrate_from_motion(rig, {}, {}, {}).error().code, ErrorCode::kMissingData);
  FromMotionOptions options;
  options.speed_rad_s = 1.1 * 2.0 * std::numbers::pi / 30.0;
  const auto found = calibrate_from_motion(rig, options, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_LT(axis_error_deg(rig, *found), 0.1);
  EXPECT_LT(mean_angle_error_deg(rig, *found), 0.02);
  EXPECT_EQ(found->undetermined, (std::vector<std::string>{"angles", "speed"}));
}

/// Median deviation of the distances from the axis, of what stands on the table between two
/// heights.
double roundness_mm(const testing::Rig& rig, const Calibration& c) {
  const SensorInfo& sensor = rig.header().sensors.front();
  const RayTable rays(sensor.intrinsics);
  const Pose T = *table_from_sensor(c.table);
  std::vector<double> radii;
  for (std::size_t i = 0; i < rig.frames().size(); ++i) {
    const auto points = points_of(*rig.read(i), sensor, rays);
    for (const Vec3f& p : points->cloud.points) {
      const Vec3d q = T * p.cast<double>();
      if (q.y() > 0.02 && q.y() < 0.08 && std::hypot(q.x(), q.z()) < 0.1)
        radii.push_back(std::hypot(q.x(), q.z()));
    }
  }
  // Mixed pixels lie far off.
  const double middle = median(radii);
  for (double& r : radii) r = std::abs(r - middle);
  return 1e3 * median(radii);
}

TEST(CalibrateFromMotion, MakesACylinderNoWorseThanThePlatterAlone) {
  const testing::Rig rig(rig_options("cylinder", 40, 1.1));
  FromMotionOptions options;
  options.speed_rad_s = 1.1 * 2.0 * std::numbers::pi / 30.0;
  const auto found = calibrate_from_motion(rig, options, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  const auto scan = average_frames(rig, spread_positions(rig, 0, 40), {}, {});
  ASSERT_TRUE(scan) << scan.error().text();
  const auto platter = detect_platter(*scan, {}, {});
  ASSERT_TRUE(platter) << platter.error().text();
  EXPECT_LT(roundness_mm(rig, *found), 1.005 * roundness_mm(rig, calibration_of(*platter, *scan)));
}

TEST(CalibrateFromMotion, RefusesASceneThatStandsStillAndTooFewFrames) {
  testing::RigOptions o = rig_options("doll", 2, 1.1);
  EXPECT_EQ(calibrate_from_motion(testing::Rig(o), {}, {}, {}).error().code,
            ErrorCode::kTooFewPoints);
  o.frames = 12;
  o.objects.clear();
  EXPECT_FALSE(calibrate_from_motion(testing::Rig(o), {}, {}, {}));
}

TEST(CalibrateFromMotion, IsTheSameForAnyNumberOfThreads) {
  const testing::Rig rig(rig_options("letter-a", 30, 1.1));
  const auto many = calibrate_from_motion(rig, {}, {}, {});
  set_thread_count(1);
  const auto one = calibrate_from_motion(rig, {}, {}, {});
  set_thread_count(0);
  ASSERT_TRUE(many && one);
  EXPECT_EQ(many->table.axis, one->table.axis);
  EXPECT_EQ(many->angles_rad, one->angles_rad);
}

TEST(CalibrateFromMotion, RefusesWrongOptionsAndCancelling) {
  const testing::Rig rig(rig_options("letter-a", 12, 1.1));
  FromMotionOptions options;
  options.key_frames = 1;
  EXPECT_EQ(calibrate_from_motion(rig, options, {}, {}).error().code, ErrorCode::kInvalidOption);
  options = {};
  options.angle_sigma_rad = std::nan("");
  EXPECT_EQ(calibrate_from_motion(rig, options, {}, {}).error().code, ErrorCode::kInvalidOption);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(calibrate_from_motion(rig, {}, {}, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
