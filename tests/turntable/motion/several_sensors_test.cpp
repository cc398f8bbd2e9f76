// Several sensors before one turntable.

#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/virtual_scan.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

struct Stand {
  double azimuth_deg = 0.0, elevation_deg = 20.0, distance_m = 0.7;
};

/// Rendered once, and what is true of it.
struct TwoSensorScan : testing::MemorySequence {
  std::vector<Pose> poses;
  std::vector<double> angles;
};

TwoSensorScan scan_of(const std::string& object, const std::vector<Stand>& stands, int frames,
                      double slip_at_s = 0.0, double slip_rad = 0.0) {
  ScannerParameters p;
  p.name = "camera";
  p.columns = 120, p.rows = 105;
  p.fov_y_rad = 36.0 / kDegreesPerRadian;
  p.near_m = 0.2, p.far_m = 3.0;
  VirtualScanOptions o;
  for (const Stand& stand : stands) {
    VirtualScanner scanner{*scanner_model(p), {}};
    scanner.placement.azimuth_rad = stand.azimuth_deg / kDegreesPerRadian;
    scanner.placement.elevation_rad = stand.elevation_deg / kDegreesPerRadian;
    scanner.placement.distance_m = stand.distance_m;
    scanner.placement.aim_height_m = 0.05;
    o.scanners.push_back(scanner);
  }
  o.motion.frames = frames;
  o.motion.turns = 1.1;
  o.motion.slip_at_s = slip_at_s;
  o.motion.slip_rad = slip_rad;
  o.measure.noise = "gaussian:1mm";
  o.record.calibration = RecordedCalibration::kNone;
  o.record.angles = false;
  auto scan = VirtualScan::create({*builtin_object(object)}, o);
  EXPECT_TRUE(scan);
  TwoSensorScan out;
  out.header_value = scan->header();
  for (std::size_t i = 0; i < scan->frames().size(); ++i) {
    out.add(*scan->read(i));
    out.poses.push_back(scan->T_table_sensor(i));
    out.angles.push_back(scan->angle_rad(i));
  }
  return out;
}

/// The truth of a sensor's place beside the calibration's, both in the frame of sensor 0: how far a
/// point of the object is off, and by how much the sensor is turned.
struct Off {
  double point_m, turn_deg;
};
Off off_truth(const TwoSensorScan& scan, const Calibration& found, std::size_t sensor) {
  std::size_t position = 0;
  while (scan.frames()[position].sensor != sensor) ++position;
  const Pose truth = rotation_about_y(scan.angles[position]) * scan.poses[position];
  const Pose off = found.others[sensor - 1].T_table_sensor * truth.inverse();
  return {(off * Vec3d(0.05, 0.1, 0.0) - Vec3d(0.05, 0.1, 0.0)).norm(),
          Eigen::AngleAxisd(off.linear()).angle() * kDegreesPerRadian};
}

TEST(MotionOfSeveralSensors, BringsThemToOneHeadingWhereverTheyStand) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const TwoSensorScan scan = scan_of("doll", {{0, 15}, {130, 40}}, 36);
  const auto found = calibrate_from_motion(scan, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_EQ(found->others.size(), 1u);
  const Off off = off_truth(scan, *found, 1);
  EXPECT_LT(off.point_m, 0.001);
  EXPECT_LT(off.turn_deg, 0.5);
  EXPECT_LT(found->others[0].heading_sigma_rad * kDegreesPerRadian, 0.5);
  ASSERT_EQ(found->angles_rad.size(), scan.frames().size());
  for (std::size_t i = 0; i < found->angles_rad.size(); ++i)
    EXPECT_NEAR(found->angles_rad[i], scan.angles[i], 0.6 / kDegreesPerRadian) << i;
  // The sequence with it is one that reconstruction can place.
  const auto placed = with_calibration(scan, *found);
  ASSERT_TRUE(placed);
  EXPECT_TRUE((*placed)->header().sensors[1].T_table_sensor);
}

TEST(MotionOfSeveralSensors, SaysWhenTheObjectShowsNoHeading) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const TwoSensorScan scan = scan_of("cylinder", {{0, 20}, {90, 35}}, 24);
  FromMotionOptions options;
  EXPECT_EQ(calibrate_from_motion(scan, options, {}, {}).error().code, ErrorCode::kMissingData);
  options.speed_rad_s = 1.1 * 2.0 * std::numbers::pi / (24 / 30.0);
  const auto found = calibrate_from_motion(scan, options, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_TRUE(std::isnan(found->others[0].heading_sigma_rad));
  EXPECT_NE(
      std::find(found->undetermined.begin(), found->undetermined.end(), "heading of sensor 1"),
      found->undetermined.end());
}

TEST(MotionOfSeveralSensors, NamesTheFrameOfTheWholeRecordingAfterASlip) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  constexpr double kSlipAt_s = 1.0;
  const TwoSensorScan scan = scan_of("doll", {{}, {100.0, 15.0, 0.7}}, 60, kSlipAt_s, 0.2);
  const auto found = calibrate_from_motion(scan, {}, {}, {});
  ASSERT_TRUE(found) << found.error().text();
  ASSERT_EQ(found->slips.size(), 1u);
  const std::size_t first = found->slips[0].first_frame;
  EXPECT_EQ(scan.frames()[first].sensor, 0u);
  EXPECT_NEAR(scan.frames()[first].time_s, kSlipAt_s, 0.05);
}

TEST(MotionOfSeveralSensors, IsTheSameForAnyNumberOfThreadsAndCanBeCancelled) {
  const TwoSensorScan scan = scan_of("letter-a", {{0, 15}, {-60, 35}}, 16);
  const auto many = calibrate_from_motion(scan, {}, {}, {});
  set_thread_count(1);
  const auto one = calibrate_from_motion(scan, {}, {}, {});
  set_thread_count(0);
  ASSERT_TRUE(many) << many.error().text();
  ASSERT_TRUE(one);
  EXPECT_EQ(many->others[0].T_table_sensor.matrix(), one->others[0].T_table_sensor.matrix());
  EXPECT_EQ(many->angles_rad, one->angles_rad);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(calibrate_from_motion(scan, {}, {}, context).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace turnscan
