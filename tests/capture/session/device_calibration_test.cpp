#include <gtest/gtest.h>

#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/session/taken_frames.hpp>

#include "tests/capture/taking.hpp"
#include "tests/support/sanitizers.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::opened;
using testing::TempFolder;
using testing::Variable;

const std::string kRig = "virtual:cylinder?elevation=30deg&noise=gaussian:1mm&room=desk";

AveragedScan averaged(const std::string& uri, std::size_t count = 10) {
  const auto source = opened(uri);
  const auto frames = take_frames(*source, count, {});
  EXPECT_TRUE(frames) << (frames ? "" : frames.error().text());
  return average_frames(**frames, spread_positions(**frames, 0, count), {}, {}).value();
}

const Calibration& calibrated() {
  static const Calibration calibration = [] {
    const AveragedScan scan = averaged(kRig);
    return calibration_of(detect_platter(scan, {}, {}).value(), scan);
  }();
  return calibration;
}

TEST(TakeFrames, TakesAsManyAsAskedAndGoesOnAfterThem) {
  const auto source = opened(kRig + "&prepared=1&fault=gap@50ms");
  const auto first = take_frames(*source, 3, {});
  ASSERT_TRUE(first);
  // The lost one is there, but does not count.
  ASSERT_EQ((*first)->frames().size(), 4u);
  EXPECT_EQ((*first)->frames()[2].status, FrameStatus::kDropped);
  EXPECT_FALSE((*first)->read(2));
  EXPECT_EQ((*first)->read(3)->depth.width, 512);
  const auto second = take_frames(*source, 1, {});
  EXPECT_GT((*second)->frames()[0].index, 3u);
}

TEST(TakeFrames, EndsWithTheSourceAndFailsWithoutAFrame) {
  EXPECT_EQ((*take_frames(*opened(kRig + "&frames=2"), 50, {}))->frames().size(), 2u);
  EXPECT_EQ(take_frames(*opened(kRig + "&frames=2&dropped=1"), 50, {}).error().code,
            ErrorCode::kTooFewPoints);
  const RunContext context;
  context.cancel();
  EXPECT_EQ(take_frames(*opened(kRig), 5, context).error().code, ErrorCode::kCancelled);
}

TEST(KeptCalibration, ComesBackWithoutWhatWasOfOneRecording) {
  const TempFolder folder;
  const Variable state("XDG_STATE_HOME", (folder / "state").string());
  EXPECT_FALSE(kept_calibration("kinect-1").value());
  Calibration calibration = calibrated();
  calibration.angles_rad = {0.0, 0.1};
  calibration.start_s = 3.0;
  ASSERT_TRUE(keep_calibration("kinect-1", calibration));
  const auto kept = kept_calibration("kinect-1").value();
  ASSERT_TRUE(kept);
  EXPECT_TRUE(kept->angles_rad.empty());
  EXPECT_FALSE(kept->start_s);
  EXPECT_LT((kept->table.center_m - calibration.table.center_m).norm(), 1e-9);
  EXPECT_FALSE(kept_calibration("kinect-2").value());
  EXPECT_EQ(kept_calibration_file("kinect-1").value(),
            folder / "state/turnscan/calibrations/kinect-1.json");
}

TEST(KeptCalibration, LiesInTheHomeFolderUnlessToldOtherwise) {
  const TempFolder folder;
  const Variable state("XDG_STATE_HOME", "relative");
  const Variable home("HOME", folder.path().string());
  EXPECT_EQ(kept_calibration_file("a").value(),
            folder / ".local/state/turnscan/calibrations/a.json");
  const Variable nowhere("HOME", "");
  EXPECT_EQ(kept_calibration_file("a").error().code, ErrorCode::kNotFound);
}

TEST(CheckRig, ARigThatStandsIsToldFromOneThatWasMoved) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  struct Case {
    const char* change;
    bool moved;
  };
  // Other noise, another object, none; then the table itself.
  for (const Case& c :
       {Case{"&seed=7", false}, Case{"&seed=8&object-x=20mm", false}, Case{"&table-x=10mm", true},
        Case{"&table-y=5mm", true}, Case{"&table-tilt=2deg", true}, Case{"&table-z=400mm", true}}) {
    const auto check = check_rig(averaged(kRig + c.change, 6), calibrated(), {});
    ASSERT_TRUE(check);
    EXPECT_EQ(check->moved, c.moved) << c.change << ": " << check->text;
    EXPECT_EQ(check->text.find("; calibrate anew") != std::string::npos, c.moved);
  }
}

TEST(CheckRig, SaysByHowMuch) {
  const auto check = check_rig(averaged(kRig + "&table-y=5mm", 6), calibrated(), {});
  ASSERT_TRUE(check);
  EXPECT_NEAR(check->height_m, 0.005, 0.001);
}

}  // namespace
}  // namespace turnscan
