#include <gtest/gtest.h>

#include <turnscan/workflow/calibration/calibrate_run.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/calibration/sensor_correction.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::MemorySequence;
using testing::TempFolder;

MemorySequence empty_sequence(std::size_t sensors) {
  MemorySequence out;
  out.header_value.sensors.resize(sensors);
  return out;
}

TEST(CalibrateRun, NeedsAKnownSizeForTheBiasOfDepth) {
  CalibrateRequest request;
  request.depth_bias = true;
  const auto result = run_calibration(empty_sequence(1), request, RunContext());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidOption);
}

TEST(CalibrateRun, HasNoSensorForASecondCamera) {
  CalibrateRequest request;
  request.iai_folders = {"a", "b"};
  const auto result = run_calibration(empty_sequence(1), request, RunContext());
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidOption);
}

TEST(CalibrateRun, TakesTheCircleThroughPickedPoints) {
  const TempFolder folder;
  CalibrateRequest request;
  request.way = CalibrationWay::kPoints;
  // A rim of 100 mm radius in the plane y = 50 mm, below the sensor.
  request.points = folder
                       .put("picks.csv",
                            "x_mm,y_mm,z_mm\n100,50,900\n0,50,1000\n-100,50,900\n0,50,800\n"
                            "60,50,980\n-60,50,820\n")
                       .string();
  const auto result = run_calibration(empty_sequence(1), request, RunContext());
  ASSERT_TRUE(result) << result.error().text();
  EXPECT_LT((result->table.center_m - Vec3d(0.0, 0.05, 0.9)).norm(), 1e-6);
  EXPECT_NEAR(result->table.radius_m.value_or(0.0), 0.1, 1e-6);
  EXPECT_LT((result->table.axis - Vec3d(0.0, -1.0, 0.0)).norm(), 1e-6) << "towards the sensor";
}

TEST(CalibrateRun, NotesACorrectionThatHasNoPlaceInTheCalibration) {
  Calibration correction, found;
  correction.depth.emplace();
  correction.others.resize(1);
  correction.others[0].depth.emplace();
  workflow::keep_corrections(correction, found);
  EXPECT_TRUE(found.depth);
  EXPECT_EQ(found.notes.size(), 1u);
  found = Calibration();
  found.others.resize(1);
  workflow::keep_corrections(correction, found);
  EXPECT_TRUE(found.others[0].depth);
  EXPECT_TRUE(found.notes.empty());
}

TEST(CalibrationChoiceOf, RecordedKeepsWhatTheRecordingSays) {
  const MemorySequence sequence = empty_sequence(1);
  const auto choice = choose_calibration(sequence, {"recorded", {}, false}, RunContext());
  ASSERT_TRUE(choice);
  EXPECT_FALSE(choice->calibration);
  EXPECT_TRUE(choice->poses.empty() && choice->note.empty());
}

}  // namespace
}  // namespace turnscan
