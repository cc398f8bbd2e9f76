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

/// A finished recording of four frames with this table.
void with_table(const TempFolder& temp, const std::string& table) {
  unfinished(temp / "r", 4);
  temp.put("r/frames.csv", table);
  ASSERT_TRUE(Recording::open(temp / "r"));
}

TEST(Repair, KeepsNamesThatNeedQuotes) {
  const TempFolder temp;
  unfinished(temp / "r", 2);
  fs::rename(temp / "r/depth/000001.png", temp / "r/depth/a,1.png");
  temp.put("r/frames.csv", "index,file,status\n0,depth/000000.png,ok\n1,\"depth/a,1.png\",ok\n2,x");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->frames, 2u);
  EXPECT_THAT(content_of(temp / "r/frames.csv"), HasSubstr("1,\"depth/a,1.png\",ok\n"));
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording) << recording.error().text();
  EXPECT_TRUE(recording->notes().empty());
}

TEST(Repair, KeepsTheFilesThatItReplaces) {
  const TempFolder temp;
  unfinished(temp / "r", 2);
  const std::string json = content_of(temp / "r/recording.json");
  const std::string csv = put_text(temp, "r/frames.csv", content_of(temp / "r/frames.csv") + "2,0");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(content_of(temp / "r/frames.csv.before-repair"), csv);
  EXPECT_EQ(content_of(temp / "r/recording.json.before-repair"), json);
  const std::string again = put_text(temp, "r/frames.csv", content_of(temp / "r/frames.csv") + "3");
  ASSERT_TRUE(repair_recording(temp / "r"));
  EXPECT_EQ(content_of(temp / "r/frames.csv.before-repair"), csv);
  EXPECT_EQ(content_of(temp / "r/frames.csv.before-repair-2"), again);
}

TEST(Repair, MarksNothingThatCannotBeReadJustNow) {
  const TempFolder temp;
  unfinished(temp / "r", 3);
  const std::string csv = content_of(temp / "r/frames.csv");
  // A loop of links cannot be opened by anybody, the superuser included.
  fs::rename(temp / "r/depth/000001.png", temp / "r/depth/kept.png");
  fs::create_symlink("000001.png", temp / "r/depth/000001.png");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->unreadable, 1u);
  EXPECT_EQ(report->dropped, 0u);
  EXPECT_THAT(report->done, ::testing::Contains(HasSubstr("cannot be opened")));
  EXPECT_EQ(content_of(temp / "r/frames.csv"), csv);
  EXPECT_THAT(Recording::open(temp / "r")->notes(),
              ::testing::ElementsAre(HasSubstr("cannot be opened")));
  fs::rename(temp / "r/depth/kept.png", temp / "r/depth/000001.png");
  EXPECT_TRUE(Recording::open(temp / "r")->notes().empty());
}

TEST(Repair, KeepsTheNamesOfDroppedFrames) {
  const TempFolder temp;
  with_table(temp,
             "index,file,color_file,status\n0,depth/000000.png,c.png,dropped\n"
             "1,depth/gone.png,,ok\n2,depth/000002.png,color/gone.png,ok\n3,");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->dropped, 1u);
  EXPECT_EQ(content_of(temp / "r/frames.csv"),
            "index,file,color_file,status\n0,depth/000000.png,c.png,dropped\n"
            "1,depth/gone.png,,dropped\n2,depth/000002.png,color/gone.png,ok\n");
}

TEST(Repair, MarksLostFramesInATableOfOthers) {
  const TempFolder temp;
  with_table(temp, "mood,file,index\r\n\"so, so\",depth/000001.png,1\r\nbad,depth/gone.png,0\r\n");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->dropped, 1u);
  EXPECT_EQ(content_of(temp / "r/frames.csv"),
            "mood,file,index,status\r\nbad,depth/gone.png,0,dropped\r\n"
            "\"so, so\",depth/000001.png,1,\r\n");
}

TEST(Repair, KeepsTheFieldsOfOtherPrograms) {
  const TempFolder temp;
  unfinished(temp / "r", 1);
  std::string json = content_of(temp / "r/recording.json");
  json.insert(1, "\n  \"my_lab\": {\"complete\": false, \"who\": \"A, \\\"B\\\"\"},");
  put_text(temp, "r/recording.json", json);
  ASSERT_TRUE(repair_recording(temp / "r"));
  const std::string after = content_of(temp / "r/recording.json");
  EXPECT_THAT(after, HasSubstr("\"my_lab\": {\"complete\": false, \"who\": \"A, \\\"B\\\"\"},"));
  EXPECT_THAT(after, HasSubstr("\"frame_count\": 1"));
  EXPECT_TRUE(Recording::open(temp / "r")->complete());
}

TEST(Repair, StaysInsideTheRecording) {
  const TempFolder temp;
  unfinished(temp / "r", 1);
  fs::create_directory(temp / "out");
  temp.put("out/.x.1-0.part", "not of this recording");
  temp.put("r/.x.part", "of another program");
  fs::create_directory_symlink("../out", temp / "r/points");
  const auto report = repair_recording(temp / "r");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->leftovers, 0u);
  EXPECT_EQ(report->without_line, 0u);
  EXPECT_TRUE(fs::exists(temp / "out/.x.1-0.part"));
  EXPECT_TRUE(fs::exists(temp / "r/.x.part"));
}

TEST(Repair, RefusesWhatIsNoRecording) {
  const TempFolder temp;
  EXPECT_EQ(repair_recording(temp / "none").error().code, ErrorCode::kNotFound);
}

TEST(Repair, ChangesNothingWhenCancelled) {
  const TempFolder temp;
  unfinished(temp / "r", 3);
  const std::string before = content_of(temp / "r/recording.json");
  RunContext context;
  context.cancel();
  const auto report = repair_recording(temp / "r", context);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(content_of(temp / "r/recording.json"), before);
}

}  // namespace
}  // namespace turnscan
