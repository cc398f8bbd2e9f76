#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/repair.hpp>

#include "tests/recording/sequences.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using testing::content_of;
using testing::depth_frame;
using ::testing::HasSubstr;
using testing::small_header;
using testing::TempFolder;

/// A recording whose writer ended without finish().
void unfinished(const fs::path& folder, std::uint32_t frames) {
  auto writer = RecordingWriter::create(folder, small_header());
  ASSERT_TRUE(writer);
  for (std::uint32_t i = 0; i < frames; ++i) ASSERT_TRUE(writer->append(depth_frame(i)));
}

std::string put_text(const TempFolder& temp, const char* name, const std::string& text) {
  temp.put(name, text);
  return text;
}

TEST(Repair, FinishesARecordingThatWasNotFinished) {
  const TempFolder temp;
  unfinished(temp / "r", 5);
  const std::string before = content_of(temp / "r/frames.csv");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_FALSE(report->was_complete);
  EXPECT_EQ(report->frames, 5u);
  EXPECT_TRUE(report->done.empty());
  EXPECT_EQ(content_of(temp / "r/frames.csv"), before);
  const auto recording = Recording::open(temp / "r");
  EXPECT_TRUE(recording->complete());
  EXPECT_TRUE(recording->notes().empty());
  EXPECT_EQ(recording->frames().size(), 5u);
}

TEST(Repair, SaysWhatWasLostAndKeepsEveryImage) {
  const TempFolder temp;
  unfinished(temp / "r", 6);
  fs::resize_file(temp / "r/depth/000004.png", 20);
  fs::copy_file(temp / "r/depth/000000.png", temp / "r/depth/000006.png");
  put_text(temp, "r/depth/.000007.png.1-2.part", "half");
  put_text(temp, "r/frames.csv", content_of(temp / "r/frames.csv") + "7,0.2,0,0,0,1e");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 5u);
  EXPECT_EQ(report->dropped, 1u);
  EXPECT_EQ(report->without_line, 1u);
  EXPECT_EQ(report->leftovers, 1u);
  EXPECT_EQ(report->done.size(), 4u);
  EXPECT_TRUE(fs::exists(temp / "r/depth/000006.png"));
  EXPECT_FALSE(fs::exists(temp / "r/depth/.000007.png.1-2.part"));
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording);
  EXPECT_TRUE(recording->notes().empty());
  ASSERT_EQ(recording->frames().size(), 6u);
  EXPECT_EQ(recording->frames()[4].status, FrameStatus::kDropped);
  EXPECT_TRUE(recording->read(5));
}

TEST(Repair, DoneTwiceChangesNothing) {
  const TempFolder temp;
  unfinished(temp / "r", 3);
  ASSERT_TRUE(repair_recording(temp / "r"));
  const std::string csv = content_of(temp / "r/frames.csv");
  const std::string json = content_of(temp / "r/recording.json");
  const auto again = repair_recording(temp / "r");
  ASSERT_TRUE(again);
  EXPECT_TRUE(again->was_complete);
  EXPECT_EQ(content_of(temp / "r/frames.csv"), csv);
  EXPECT_EQ(content_of(temp / "r/recording.json"), json);
}

TEST(Repair, MakesARecordingWithoutFramesWhole) {
  const TempFolder temp;
  unfinished(temp / "r", 0);
  fs::remove(temp / "r/frames.csv");
  ASSERT_TRUE(repair_recording(temp / "r"));
  EXPECT_TRUE(Recording::open(temp / "r")->notes().empty());
}

TEST(Repair, RefusesWhatIsBeingRecorded) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", small_header());
  ASSERT_TRUE(writer->append(depth_frame(0)));
  const auto report = repair_recording(temp / "r");
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kIo);
  EXPECT_THAT(report.error().message, HasSubstr("being recorded"));
  EXPECT_TRUE(writer->append(depth_frame(1)));
  EXPECT_TRUE(writer->finish());
}

TEST(Repair, KeepsColumnsThatItDoesNotKnow) {
  const TempFolder temp;
  unfinished(temp / "r", 1);
  put_text(temp, "r/frames.csv", "index,file,mood\n0,depth/000000.png,good\n1,dep");
  ASSERT_TRUE(repair_recording(temp / "r"));
  EXPECT_EQ(content_of(temp / "r/frames.csv"), "index,file,mood\n0,depth/000000.png,good\n");
}

TEST(Repair, RefusesWhatIsNoRecording) {
  const TempFolder temp;
  EXPECT_EQ(repair_recording(temp / "none").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace turnscan
