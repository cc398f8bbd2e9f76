#include <gtest/gtest.h>

#include <filesystem>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/workflow/calibration/calibration_age.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>

#include "tests/support/memory_sequence.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using workflow::age_text;
using workflow::dates_of;

TEST(CalibrationAge, IsSaidInWords) {
  EXPECT_EQ(age_text({"2026-11-01T08:00:00Z", "2026-08-01T08:00:00Z"}),
            "The calibration was made 3 months before this recording (2026-08-01).");
  EXPECT_EQ(age_text({"2026-11-01T08:00:00Z", "2026-11-01T07:20:00Z"}),
            "The calibration was made 40 minutes before this recording (2026-11-01).");
  EXPECT_EQ(age_text({"2026-11-01T08:00:00Z", "2026-11-03T08:00:00Z"}),
            "The calibration was made 2 days after this recording (2026-11-03).");
  EXPECT_EQ(age_text({"", "2026-11-03T08:00:00Z"}),
            "The calibration was made on 2026-11-03. When this was recorded is not known.");
  EXPECT_EQ(age_text({"2026-11-01T08:00:00Z", ""}), "When the calibration was made is not known.");
}

TEST(CalibrationAge, ComesFromTheRecordingOrFromTheFileThatIsUsedInstead) {
  const testing::TempFolder folder;
  const auto& dir = folder.path();
  SceneDescription scene;
  scene.object = "builtin:cylinder";
  scene.motion.frames = 2;
  const auto simulation = prepare_simulation(scene, {});
  auto writer = RecordingWriter::create(
      dir / "r", simulation->scan.header(),
      {{kStartedAt, "2026-11-01T08:00:00Z"}, {kTableCalibratedAt, "no date"}});
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->finish());
  const auto recording = Recording::open(dir / "r");
  ASSERT_TRUE(recording);
  EXPECT_EQ(dates_of(*recording).started_at, "2026-11-01T08:00:00Z");
  EXPECT_EQ(dates_of(*recording).calibrated_at, "") << "which is no date";
  Calibration calibration;
  calibration.made_at = "2025-01-01T00:00:00Z";
  ASSERT_TRUE(write_calibration(dir / "c.json", calibration));
  EXPECT_EQ(dates_of(*recording, (dir / "c.json").string()).calibrated_at, calibration.made_at);
  EXPECT_EQ(dates_of(simulation->scan).started_at, "") << "it was never recorded";
}

/// A ball on the platter, and a turntable that is wrong by so much.
testing::MemorySequence scan_with_table_off(double height_m) {
  SceneDescription scene;
  scene.object = "builtin:ball";
  scene.motion.frames = 12;
  const auto simulation = prepare_simulation(scene, {});
  testing::MemorySequence out;
  out.header_value = simulation->scan.header();
  for (std::size_t i = 0; i < simulation->scan.frames().size(); ++i)
    out.add(*simulation->scan.read(i));
  TurntableInfo& table = *out.header_value.turntable;
  table.center_m += height_m * table.axis;
  return out;
}

TEST(PlatterAgainstCalibration, SeesAStaleOne) {
  const auto good = workflow::platter_against_calibration(scan_with_table_off(0.0), {}, {});
  ASSERT_TRUE(good && *good);
  EXPECT_FALSE((*good)->moved) << (*good)->text;
  EXPECT_NEAR((*good)->height_m, 0.0, 0.001);
  const auto stale = workflow::platter_against_calibration(scan_with_table_off(0.006), {}, {});
  ASSERT_TRUE(stale && *stale);
  EXPECT_TRUE((*stale)->moved);
  EXPECT_NEAR((*stale)->height_m, -0.006, 0.001);
}

TEST(PlatterAgainstCalibration, BelievesAPlatterFoundBeforeOnlyWhereTheCalibrationHasIt) {
  const auto scan = scan_with_table_off(0.0);
  const TurntableInfo& table = *scan.header_value.turntable;
  DetectedPlatter found;
  found.axis = table.axis;
  found.center_m = table.center_m + 0.002 * table.axis;
  const auto known = workflow::platter_against_calibration(scan, found, {});
  ASSERT_TRUE(known && *known);
  EXPECT_NEAR((*known)->height_m, 0.002, 1e-9) << "not looked for again";
  found.center_m = table.center_m + 0.05 * table.axis;
  const auto anew = workflow::platter_against_calibration(scan, found, {});
  ASSERT_TRUE(anew && *anew);
  EXPECT_NEAR((*anew)->height_m, 0.0, 0.001) << "another disc";
}

TEST(PlatterAgainstCalibration, SaysNothingWithoutATurntable) {
  auto scan = scan_with_table_off(0.0);
  scan.header_value.turntable.reset();
  const auto check = workflow::platter_against_calibration(scan, {}, {});
  ASSERT_TRUE(check);
  EXPECT_FALSE(*check);
}

}  // namespace
}  // namespace turnscan
