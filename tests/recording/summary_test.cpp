#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>
#include <turnscan/recording/summary.hpp>

#include "tests/recording/sequences.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::color_image;
using testing::CountingFrames;
using testing::depth_frame;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::scan_frame;
using testing::scanner_header;
using testing::small_header;

SequenceSummary summary_of(const FrameSequence& sequence) {
  auto summary = summarize(sequence, RunContext());
  EXPECT_TRUE(summary);
  return summary.value_or(SequenceSummary{});
}

TurntableInfo table() {
  return {Vec3d(0, -1, 0), Vec3d(0, 0.1, 0.9), 0.15, std::nullopt, std::nullopt};
}

std::vector<Frame> frames(std::uint32_t count) {
  std::vector<Frame> out;
  for (std::uint32_t i = 0; i < count; ++i) out.push_back(depth_frame(i));
  return out;
}

TEST(Summary, CountsFramesAndSpans) {
  SequenceHeader header = small_header();
  header.turntable = table();
  std::vector<Frame> data = frames(41);
  data[40].info.status = FrameStatus::kDropped;
  data[39].info.pass = 1;
  for (Frame& frame : data) frame.color = color_image(0);
  const SequenceSummary s = summary_of(CountingFrames(header, data));
  EXPECT_EQ(s.frames, 41u);
  EXPECT_EQ(s.dropped, 1u);
  EXPECT_EQ(s.passes, 2u);
  EXPECT_EQ(s.with_time, 40u);
  EXPECT_EQ(s.with_angle, 40u);
  EXPECT_EQ(s.with_pose, 0u);
  EXPECT_NEAR(s.time_s->max, 1.3, 1e-12);
  EXPECT_NEAR(*s.turns, 3.9 / (2 * std::numbers::pi), 1e-12);
  EXPECT_THAT(s.not_known, IsEmpty());
  ASSERT_EQ(s.sensors.size(), 1u);
  EXPECT_EQ(s.sensors[0].frames, 40u);
  EXPECT_EQ(s.sensors[0].sampled, 16u);
  EXPECT_EQ(s.sensors[0].colored, 16u);
  EXPECT_EQ(s.sensors[0].points_per_frame, 46u);  // of 48 pixels one is empty, one cropped
  EXPECT_NEAR(s.sensors[0].valid_share, 46.0 / 48.0, 1e-12);
  EXPECT_NEAR(s.sensors[0].depth_m->min, 0.5014, 1e-9);
}

TEST(Summary, OfTimesTheSpeedIsNotKnown) {
  SequenceHeader header = small_header();
  header.turntable = table();
  std::vector<Frame> data = frames(3);
  for (Frame& frame : data) frame.info.angle_rad.reset();
  EXPECT_THAT(
      summary_of(CountingFrames(header, data)).not_known,
      ElementsAre(HasSubstr("the speed of the table, in spite of the times of 3 of 3 frames")));
  header.turntable->speed_rad_s = 0.5;
  const SequenceSummary s = summary_of(CountingFrames(header, data));
  EXPECT_THAT(s.not_known, IsEmpty());
  EXPECT_NEAR(*s.turns, 0.5 * 2 / 30.0 / (2 * std::numbers::pi), 1e-12);
}

TEST(Summary, OfAnglesTheTableIsNotKnown) {
  SequenceHeader header = small_header();
  EXPECT_THAT(summary_of(CountingFrames(header, frames(3))).not_known,
              ElementsAre(HasSubstr("axis and centre")));
  header.sensors[0].T_table_sensor = Pose::Identity();
  EXPECT_THAT(summary_of(CountingFrames(header, frames(3))).not_known, IsEmpty());
}

TEST(Summary, PosesNeedNoTable) {
  std::vector<Frame> data{scan_frame(0), scan_frame(1)};
  for (Frame& frame : data) frame.info.T_table_sensor = Pose::Identity();
  const SequenceSummary s = summary_of(CountingFrames(scanner_header(), data));
  EXPECT_THAT(s.not_known, IsEmpty());
  EXPECT_EQ(s.sensors[0].points_per_frame, 3u);
  EXPECT_NEAR(s.sensors[0].valid_share, 0.75, 1e-12);
}

TEST(Summary, OfBareFramesNeitherAngleNorTableIsKnown) {
  const SequenceSummary s =
      summary_of(CountingFrames(scanner_header(), {scan_frame(0), scan_frame(1)}));
  EXPECT_THAT(s.not_known, ElementsAre(HasSubstr("how far the table had turned in 2 of 2 frames"),
                                       HasSubstr("axis and centre")));
  EXPECT_THAT(s.not_known, Each(HasSubstr("from the object's motion")));
  EXPECT_THAT(s.missing, IsEmpty());
  EXPECT_THAT(summary_of(CountingFrames(small_header(), {})).missing,
              ElementsAre(HasSubstr("no frame")));
}

TEST(Summary, LinesOfTheSourceAfterTheFirstAreNotes) {
  SequenceHeader header = small_header();
  header.source = "somewhere\nassumed this\nassumed that";
  const SequenceSummary s = summary_of(CountingFrames(header, frames(1)));
  EXPECT_EQ(s.source, "somewhere");
  EXPECT_THAT(s.notes, ElementsAre("assumed this", "assumed that"));
}

TEST(Summary, FrameThatCannotBeReadIsANote) {
  CountingFrames sequence(small_header(), frames(3));
  sequence.broken = 1;
  const SequenceSummary s = summary_of(sequence);
  EXPECT_THAT(s.notes, ElementsAre(HasSubstr("frame 1 is broken")));
  EXPECT_EQ(s.sensors[0].sampled, 2u);
}

TEST(Summary, CancelIsReported) {
  const RunContext context;
  context.cancel();
  const auto summary = summarize(CountingFrames(small_header(), frames(3)), context);
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::kCancelled);
}

TEST(Summary, NotesOfARecordingAreTold) {
  const testing::TempFolder temp;
  ASSERT_TRUE(write_recording(temp / "r", CountingFrames(small_header(), frames(3)), RunContext()));
  std::filesystem::remove(temp / "r/depth/000001.png");
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording);
  const auto summary = summarize(*recording, RunContext());
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->dropped, 1u);
  EXPECT_THAT(summary_text(*summary), HasSubstr("note:        frame 1: depth/000001.png"));
}

TEST(Summary, TextAndJsonSayTheSame) {
  SequenceHeader header = small_header();
  header.turntable = table();
  header.source = "somewhere\nassumed this";
  const SequenceSummary s = summary_of(CountingFrames(header, frames(4)));
  const std::string text = summary_text(s);
  EXPECT_THAT(text, HasSubstr("frames:      4, 0 dropped, 1 pass\n"));
  EXPECT_THAT(text, HasSubstr("placed by:   angle, time\n"));
  EXPECT_THAT(text, HasSubstr("8 x 6 pixels"));
  EXPECT_THAT(text, HasSubstr("unit       0.1mm a step"));
  EXPECT_THAT(text, HasSubstr("radius     150mm"));
  EXPECT_THAT(text, HasSubstr("speed      not known"));
  EXPECT_THAT(text, HasSubstr("note:        assumed this"));
  const auto json = nlohmann::json::parse(summary_json(s));
  EXPECT_EQ(json["frames"], 4);
  EXPECT_EQ(json["sensors"][0]["depth_unit_m"], 1e-4);
  EXPECT_EQ(json["turntable"]["radius_m"], 0.15);
  EXPECT_EQ(json["notes"][0], "assumed this");
}

}  // namespace
}  // namespace turnscan
