#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/turntable/checks/turning_sense.hpp>
#include <turnscan/workflow/calibration/calibrate_run.hpp>
#include <turnscan/workflow/calibration/calibration_choice.hpp>
#include <turnscan/workflow/calibration/sensor_correction.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/sanitizers.hpp"
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

TEST(CalibrationChecks, TheMisfitIsThatOfTheWorseCheckAtArmsLength) {
  CalibrationChecks checks;
  EXPECT_EQ(checks.misfit_m(), 0.0);
  checks.closure.emplace();
  checks.closure->shift_m = 0.003;
  checks.closure->turn_rad = 0.04;
  EXPECT_NEAR(checks.misfit_m(), 0.005, 1e-12);
  checks.closure->turn_rad = std::nan("");
  EXPECT_NEAR(checks.misfit_m(), 0.003, 1e-12) << "a round object's turn";
  checks.axis_offset.emplace();
  checks.axis_offset->shift_m = 0.006;
  checks.axis_offset->tilt_rad = 0.08;
  EXPECT_NEAR(checks.misfit_m(), 0.010, 1e-12);
}

TEST(CalibrationChoiceOf, RecordedKeepsWhatTheRecordingSays) {
  const MemorySequence sequence = empty_sequence(1);
  const auto choice = choose_calibration(sequence, {"recorded", {}, false}, RunContext());
  ASSERT_TRUE(choice);
  EXPECT_FALSE(choice->calibration);
  EXPECT_TRUE(choice->poses.empty() && choice->note.empty());
}

/// The letter, which from frame `at` on stands 6 mm beside where it stood.
class MovedLetter : public FrameSequence {
 public:
  MovedLetter(int frames, std::size_t at)
      : before_(scan(frames, 0.0)), after_(scan(frames, 0.006)), at_(at) {}
  const SequenceHeader& header() const override { return before_.scan.header(); }
  const std::vector<FrameInfo>& frames() const override { return before_.scan.frames(); }
  Result<Frame> read(std::size_t position) const override {
    return (position < at_ ? before_ : after_).scan.read(position);
  }

 private:
  static Simulation scan(int frames, double x_m) {
    SceneDescription scene;
    scene.object = "builtin:letter-a";
    scene.motion.frames = frames;
    scene.motion.turns = 1.1;
    scene.placement.distance_m = 0.7;
    scene.object_placement.x_m = x_m;
    return prepare_simulation(scene, {}).value();
  }

  Simulation before_, after_;
  std::size_t at_;
};

TEST(CalibrationChoiceOf, AutoMovesFramesBackAndRecordedOnlySaysWhatHappened) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const MovedLetter sequence(60, 33);
  const auto choice = choose_calibration(sequence, {"auto", {}, false}, RunContext());
  ASSERT_TRUE(choice) << choice.error().text();
  EXPECT_EQ(choice->poses.size(), 60u);
  EXPECT_EQ(choice->note.find("the object moved by "), 0u) << choice->note;
  EXPECT_NE(choice->note.find("at 1.1 s"), std::string::npos) << choice->note;
  const auto placed = with_choice(sequence, *choice);
  ASSERT_TRUE(placed);
  EXPECT_TRUE((*placed)->frames()[40].T_table_sensor);
  const auto recorded = choose_calibration(sequence, {"recorded", {}, false}, RunContext());
  ASSERT_TRUE(recorded);
  EXPECT_TRUE(recorded->poses.empty());
  EXPECT_NE(recorded->note.find("nothing was corrected"), std::string::npos) << recorded->note;
}

TEST(CalibrationChoiceOf, AnglesOfTheWrongSignAreCorrectedAndMayBeAMirrorImage) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const MovedLetter letter(60, 60);
  for (const bool reversed : {false, true}) {
    const SequenceView sequence = reversed ? with_reversed_angles(letter) : SequenceView(letter);
    const auto choice = choose_calibration(sequence, {"auto", {}, false}, RunContext());
    ASSERT_TRUE(choice) << choice.error().text();
    EXPECT_EQ(choice->may_be_mirrored, reversed);
    EXPECT_EQ(choice->note.find("count the wrong way round") != std::string::npos, reversed);
  }
}

TEST(CalibrationChoiceOf, CloudsThatMayBeLeftHandedAreAskedAbout) {
  MemorySequence clouds = empty_sequence(1);
  clouds.add(Frame());
  clouds.header_value.sensors[0].kind = SensorKind::kPointScanner;
  TurntableInfo& table = clouds.header_value.turntable.emplace();
  table.center_m = Vec3d(0.0, -0.1, 0.8);
  const auto choice = choose_calibration(clouds, {"auto", {}, false}, RunContext());
  ASSERT_FALSE(choice);
  EXPECT_NE(choice.error().message.find("--axes luf or --axes ruf"), std::string::npos)
      << choice.error().message;
}

/// Every pixel as 3 x 3 of them: so many that checks look at every other one.
SequenceView with_more_pixels(const FrameSequence& recording) {
  constexpr int kTimes = 3;
  SequenceView out(recording);
  SequenceHeader header = recording.header();
  CameraIntrinsics& camera = header.sensors[0].intrinsics;
  camera.width *= kTimes, camera.height *= kTimes;
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value *= kTimes;
  camera.cx += 1.0, camera.cy += 1.0;  // of the middle one
  out.set_header(header);
  out.set_map([](Frame frame, std::size_t) -> Result<Frame> {
    DepthImage depth(kTimes * frame.depth.width, kTimes * frame.depth.height);
    for (int y = 0; y < depth.height; ++y)
      for (int x = 0; x < depth.width; ++x) depth.at(x, y) = frame.depth.at(x / kTimes, y / kTimes);
    frame.depth = std::move(depth);
    return frame;
  });
  return out;
}

TEST(CalibrationChoiceOf, WhatCoarseFramesShowIsLookedAtInFinerOnes) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const MovedLetter still(40, 40), moved(40, 22);
  const SequenceView large = with_more_pixels(still), disturbed = with_more_pixels(moved);
  const auto sound = choose_calibration(large, {"auto", {}, false}, RunContext());
  ASSERT_TRUE(sound) << sound.error().text();
  EXPECT_TRUE(sound->checks.closure && !sound->checks.closure->significant());
  EXPECT_FALSE(sound->calibration);
  EXPECT_TRUE(sound->note.empty() && sound->poses.empty()) << sound->note;
  const auto found = choose_calibration(disturbed, {"auto", {}, false}, RunContext());
  ASSERT_TRUE(found) << found.error().text();
  EXPECT_EQ(found->note.find("the object moved by "), 0u) << found->note;
  EXPECT_EQ(found->poses.size(), 40u);
}

/// The recording without its angles and speed, with its table `shift_m` beside where it stands.
SequenceView without_turning(const FrameSequence& recording, double shift_m) {
  SequenceView out(recording);
  SequenceHeader header = recording.header();
  header.turntable->speed_rad_s.reset();
  header.turntable->center_m.x() += shift_m;
  out.set_header(header);
  std::vector<FrameInfo> frames = recording.frames();
  for (FrameInfo& frame : frames) frame.angle_rad.reset();
  out.set_frames(frames);
  return out;
}

TEST(CalibrationChoiceOf, OnlyTheTurningIsTakenFromMotionWhereTheRecordingKnowsItsTable) {
  const MovedLetter letter(60, 60);
  const SequenceView sequence = without_turning(letter, 0.0);
  const auto choice = choose_calibration(sequence, {"auto", {}, false}, RunContext());
  ASSERT_TRUE(choice) << choice.error().text();
  ASSERT_TRUE(choice->calibration);
  EXPECT_EQ(choice->calibration->table.center_m, letter.header().turntable->center_m);
  EXPECT_EQ(choice->calibration->table.axis, letter.header().turntable->axis);
  EXPECT_NEAR(*choice->calibration->table.speed_rad_s, *letter.header().turntable->speed_rad_s,
              0.01 * std::abs(*letter.header().turntable->speed_rad_s));
  EXPECT_EQ(choice->note.find("the recording does not say how its table turned"), 0u)
      << choice->note;
}

TEST(CalibrationChoiceOf, ATableThatStandsElsewhereIsNotKeptForWantOfASpeed) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  const MovedLetter letter(60, 60);
  const auto choice =
      choose_calibration(without_turning(letter, 0.008), {"auto", {}, false}, RunContext());
  ASSERT_TRUE(choice) << choice.error().text();
  ASSERT_TRUE(choice->calibration);
  const Vec3d off = choice->calibration->table.center_m - letter.header().turntable->center_m;
  EXPECT_LT(off.cross(letter.header().turntable->axis).norm(), 0.001);
  EXPECT_NE(choice->note.find("found from motion: axis to"), std::string::npos) << choice->note;
}

TEST(CalibrationChoiceOf, FramesThatAreLeftOutCountAsDropped) {
  const MovedLetter sequence(12, 12);
  CalibrationChoice choice;
  choice.left_out = {3, 4};
  const auto placed = with_choice(sequence, choice);
  ASSERT_TRUE(placed);
  EXPECT_EQ((*placed)->frames()[2].status, FrameStatus::kOk);
  EXPECT_EQ((*placed)->frames()[3].status, FrameStatus::kDropped);
  EXPECT_EQ((*placed)->frames()[4].status, FrameStatus::kDropped);
}

}  // namespace
}  // namespace turnscan
