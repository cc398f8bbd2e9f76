#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <limits>
#include <map>
#include <thread>
#include <turnscan/core/parallel.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/repair.hpp>
#include <turnscan/recording/unfinished.hpp>

#include "tests/io/scarcity.hpp"
#include "tests/recording/sequences.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using testing::color_image;
using testing::content_of;
using testing::CountingFrames;
using testing::depth_frame;
using ::testing::HasSubstr;
using testing::scan_frame;
using testing::small_header;
using testing::TempFolder;

std::map<std::string, std::string> all_files(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = content_of(entry.path());
  }
  return files;
}

CountingFrames many_frames(std::uint32_t count) {
  std::vector<Frame> frames;
  for (std::uint32_t i = 0; i < count; ++i) {
    frames.push_back(depth_frame(i));
    if (i % 3 == 0) frames.back().color = color_image(i);
    if (i % 10 == 9) frames.back().info.status = FrameStatus::kDropped;
  }
  return CountingFrames(small_header(), std::move(frames));
}

TEST(RecordingWriter, MakesParentFolders) {
  const TempFolder temp;
  EXPECT_TRUE(RecordingWriter::create(temp / "a/b/c", small_header()));
  EXPECT_TRUE(fs::exists(temp / "a/b/c/recording.json"));
}

TEST(RecordingWriter, TakesAnEmptyFolderAndRefusesAnyOther) {
  const TempFolder temp;
  fs::create_directory(temp / "empty");
  EXPECT_TRUE(RecordingWriter::create(temp / "empty", small_header()));
  temp.put("file", "x");
  fs::create_directory(temp / "full");
  temp.put("full/notes.txt", "mine");
  for (const char* name : {"file", "full", "empty"}) {
    const auto writer = RecordingWriter::create(temp / name, small_header());
    ASSERT_FALSE(writer) << name;
    EXPECT_EQ(writer.error().code, ErrorCode::kAlreadyExists);
  }
  EXPECT_EQ(content_of(temp / "full/notes.txt"), "mine");
  EXPECT_EQ(all_files(temp / "full").size(), 1u);
}

TEST(RecordingWriter, KeepsAScanThatSawNothing) {
  const TempFolder temp;
  Frame nothing = scan_frame(1);
  nothing.points = {};
  nothing.grid_width = nothing.grid_height = 0;
  nothing.grid.clear();
  auto writer = RecordingWriter::create(temp / "r", testing::scanner_header());
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->append(scan_frame(0)));
  ASSERT_TRUE(writer->append(nothing));
  ASSERT_TRUE(writer->finish());
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording) << recording.error().text();
  EXPECT_TRUE(recording->notes().empty());
  ASSERT_EQ(recording->frames()[1].status, FrameStatus::kOk);
  const auto frame = recording->read(1);
  ASSERT_TRUE(frame) << frame.error().text();
  EXPECT_TRUE(frame->points.empty());
}

TEST(RecordingWriter, GoesOnWithARecordingThatIsComplete) {
  const TempFolder temp;
  auto first = RecordingWriter::create(temp / "r", small_header(), {{"gain", "2"}});
  ASSERT_TRUE(first && first->append(depth_frame(0)) && first->append(depth_frame(1)));
  EXPECT_FALSE(RecordingWriter::extend(temp / "r")) << "not complete";
  ASSERT_TRUE(first->finish());
  EXPECT_EQ(RecordingWriter::extend(temp / "r").error().code, ErrorCode::kIo) << "still held";
  first = tl::unexpected<Error>(Error());
  auto more = RecordingWriter::extend(temp / "r");
  ASSERT_TRUE(more) << more.error().text();
  EXPECT_FALSE(Recording::open(temp / "r")->complete());
  EXPECT_FALSE(more->append(depth_frame(1))) << "an index that is there";
  Frame frame = depth_frame(2);
  frame.info.pass = 1;
  ASSERT_TRUE(more->append(frame));
  ASSERT_TRUE(more->finish());
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording);
  EXPECT_TRUE(recording->complete());
  EXPECT_TRUE(recording->notes().empty());
  ASSERT_EQ(recording->frames().size(), 3u);
  EXPECT_EQ(recording->frames()[2].pass, 1u);
  EXPECT_EQ(recording->capture_settings().at("gain"), "2");
  EXPECT_EQ(recording->read(0)->depth.pixels, depth_frame(0).depth.pixels);
}

TEST(RecordingWriter, OneThatIsKilledAfterItWasResumedIsUnfinishedAsBefore) {
  for (const bool was_finished : {false, true}) {
    const TempFolder temp;
    auto writer = RecordingWriter::create(temp / "r", small_header());
    ASSERT_TRUE(writer && writer->append(depth_frame(0)));
    writer = tl::unexpected<Error>(Error());
    EXPECT_TRUE(is_unfinished_recording(temp / "r"));
    ASSERT_TRUE(repair_recording(temp / "r"));
    writer = RecordingWriter::extend(temp / "r", ColorFileFormat::kPng, 1, was_finished);
    ASSERT_TRUE(writer && writer->append(depth_frame(1)));
    writer = tl::unexpected<Error>(Error());
    EXPECT_EQ(is_unfinished_recording(temp / "r"), !was_finished);
    EXPECT_EQ(remove_unfinished_recording(temp / "r").has_value(), !was_finished);
    EXPECT_EQ(fs::exists(temp / "r" / "frames.csv"), was_finished);
  }
}

TEST(RecordingWriter, AStretchBeginsWhereARecordingWasResumed) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", small_header());
  ASSERT_TRUE(writer && writer->append(depth_frame(0)) && writer->append(depth_frame(1)));
  ASSERT_TRUE(writer->finish());
  writer = tl::unexpected<Error>(Error());
  writer = RecordingWriter::extend(temp / "r", ColorFileFormat::kPng, 2);
  // Said before the first frame comes: the writer may be killed.
  ASSERT_TRUE(writer && writer->append(depth_frame(2)));
  const auto stretches = [](const fs::path& folder) {
    std::vector<std::uint32_t> out;
    const auto recording = Recording::open(folder);
    if (recording)
      for (const FrameInfo& frame : recording->frames()) out.push_back(frame.stretch);
    return out;
  };
  EXPECT_EQ(stretches(temp / "r"), (std::vector<std::uint32_t>{0, 0, 1}));
  ASSERT_TRUE(writer->finish());
  ASSERT_TRUE(write_recording(temp / "copy", *Recording::open(temp / "r"), RunContext()));
  EXPECT_EQ(stretches(temp / "copy"), (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(RecordingWriter, AddsNothingToWhatAnotherProgramWrote) {
  const TempFolder temp;
  ASSERT_TRUE(write_recording(temp / "r", many_frames(3), RunContext()));
  EXPECT_EQ(RecordingWriter::extend(temp / "none").error().code, ErrorCode::kNotFound);
  const std::string lines = content_of(temp / "r/frames.csv");
  for (const char* other : {"index,file\n0,depth/000000.png\n", "index,file", ""}) {
    temp.put("r/frames.csv", other);
    EXPECT_EQ(RecordingWriter::extend(temp / "r").error().code, ErrorCode::kUnsupported) << other;
  }
  temp.put("r/frames.csv", lines);
  EXPECT_TRUE(RecordingWriter::extend(temp / "r"));
}

TEST(RecordingWriter, RefusesAHeaderThatIsNotUsable) {
  const TempFolder temp;
  SequenceHeader header = small_header();
  header.sensors[0].depth_unit_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(RecordingWriter::create(temp / "r", header).error().code, ErrorCode::kInvalidOption);
  header.sensors.clear();
  EXPECT_EQ(RecordingWriter::create(temp / "r", header).error().code, ErrorCode::kInvalidOption);
  EXPECT_FALSE(fs::exists(temp / "r"));
}

TEST(RecordingWriter, RefusesFramesThatDoNotFit) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", small_header());
  ASSERT_TRUE(writer);
  Frame small = depth_frame(0);
  small.depth = DepthImage(4, 4, 1000);
  Frame sensor = depth_frame(0);
  sensor.info.sensor = 1;
  Frame time = depth_frame(0);
  time.info.time_s = std::numeric_limits<double>::infinity();
  Frame angle = depth_frame(0);
  angle.info.angle_rad = std::numeric_limits<double>::quiet_NaN();
  for (const Frame& frame : {small, sensor, time, angle, scan_frame(0)}) {
    const auto done = writer->append(frame);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::kInvalidOption);
  }
  EXPECT_TRUE(writer->append(depth_frame(0)));
  EXPECT_THAT(writer->append(depth_frame(0)).error().message, HasSubstr("index 0"));
}

TEST(RecordingWriter, AppendAfterFinishThrows) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", small_header());
  ASSERT_TRUE(writer->finish());
  EXPECT_THROW((void)writer->append(depth_frame(0)), std::invalid_argument);
  EXPECT_THROW((void)writer->finish(), std::invalid_argument);
}

TEST(RecordingWriter, ColourMayBeJpeg) {
  const TempFolder temp;
  auto writer =
      RecordingWriter::create(temp / "r", small_header(), {{"gain", "3"}}, ColorFileFormat::kJpeg);
  Frame frame = depth_frame(0);
  frame.color = ColorImage(8, 6, Rgb{200, 100, 50});
  ASSERT_TRUE(writer->append(frame));
  ASSERT_TRUE(writer->finish());
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording);
  EXPECT_TRUE(recording->notes().empty());
  EXPECT_EQ(recording->capture_settings().at("gain"), "3");
  const auto back = recording->read(0);
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_NEAR(back->color.at(4, 3).r, 200, 4);
}

TEST(RecordingWriter, ColourThatItsSourcePackedAsJpegStaysByteForByte) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", small_header());
  Frame frame = depth_frame(0);
  const std::string jpeg = encode_color_jpeg(ColorImage(8, 6, Rgb{200, 100, 50}), 55).value();
  ASSERT_TRUE(decode_frame_color(jpeg, frame));
  ASSERT_TRUE(writer->append(frame));
  ASSERT_TRUE(writer->finish());
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording) << recording.error().text();
  const auto back = recording->read(0);
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_EQ(back->color_jpeg, jpeg);
  EXPECT_EQ(back->color.at(4, 3), frame.color.at(4, 3));
  // A copy of the recording loses nothing either.
  ASSERT_TRUE(write_recording(temp / "copy", *recording, RunContext()));
  EXPECT_EQ(read_file(temp / "copy" / "color" / "000000.jpg").value(), jpeg);
}

TEST(RecordingWriter, FullDiskLeavesWholeLinesAndAReadableRecording) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", small_header());
  std::uint32_t written = 0;
  {
    const testing::FullDisk full(600);  // a frame's image fits, the table soon does not
    Result<> done;
    while ((done = writer->append(depth_frame(written)))) ASSERT_LT(++written, 100u);
    EXPECT_EQ(done.error().code, ErrorCode::kIo);
  }
  EXPECT_GT(written, 2u);
  EXPECT_EQ(content_of(temp / "r/frames.csv").back(), '\n');
  EXPECT_EQ(Recording::open(temp / "r")->frames().size(), written);
  // There is space again: the recording goes on.
  EXPECT_TRUE(writer->append(depth_frame(written)));
  EXPECT_TRUE(writer->finish());
  const auto recording = Recording::open(temp / "r");
  EXPECT_EQ(recording->frames().size(), written + 1);
  EXPECT_TRUE(recording->notes().empty());
}

TEST(RecordingWriter, FullDiskWithinAnImageLeavesNoLineAndNoFile) {
  const TempFolder temp;
  auto writer = RecordingWriter::create(temp / "r", small_header());
  ASSERT_TRUE(writer->append(depth_frame(0)));
  {
    const testing::FullDisk full(40);
    EXPECT_EQ(writer->append(depth_frame(1)).error().code, ErrorCode::kIo);
  }
  EXPECT_EQ(all_files(temp / "r").size(), 3u);
  EXPECT_EQ(Recording::open(temp / "r")->frames().size(), 1u);
}

/// Writes frames until it is killed. Says through the pipe when the recording exists.
[[noreturn]] void write_for_ever(const fs::path& folder, int pipe) {
  auto writer = RecordingWriter::create(folder, small_header());
  if (!writer || ::write(pipe, "x", 1) != 1) ::_exit(1);
  for (std::uint32_t i = 0;; ++i) {
    Frame frame = depth_frame(i);
    if (i % 2 == 0) frame.color = color_image(i);
    if (!writer->append(frame)) ::_exit(2);
  }
}

TEST(RecordingWriter, KilledAtAnyMomentLeavesEveryWholeFrameReadable) {
  std::size_t frames_seen = 0;
  for (int round = 0; round < 25; ++round) {
    const TempFolder temp;
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) write_for_ever(temp / "r", ends[1]);
    char ready = 0;
    ASSERT_EQ(::read(ends[0], &ready, 1), 1);
    std::this_thread::sleep_for(std::chrono::microseconds(337 * round));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer ended by itself";
    ::close(ends[0]);
    ::close(ends[1]);
    const auto recording = Recording::open(temp / "r");
    ASSERT_TRUE(recording) << recording.error().text();
    EXPECT_FALSE(recording->complete());
    for (std::size_t i = 0; i < recording->frames().size(); ++i) {
      const auto frame = recording->read(i);
      ASSERT_TRUE(frame) << frame.error().text();
      EXPECT_EQ(frame->info.index, i);
      EXPECT_EQ(frame->depth.pixels, depth_frame(frame->info.index).depth.pixels);
      EXPECT_EQ(frame->color.empty(), i % 2 == 1);
    }
    frames_seen += recording->frames().size();
  }
  EXPECT_GT(frames_seen, 0u);
}

TEST(WriteRecording, GivesTheSameBytesForAnyNumberOfThreads) {
  const TempFolder temp;
  const CountingFrames sequence = many_frames(200);
  for (const int threads : {1, 2, 7}) {
    set_thread_count(threads);
    const auto done = write_recording(temp / std::to_string(threads), sequence, RunContext());
    ASSERT_TRUE(done) << done.error().text();
  }
  set_thread_count(0);
  const auto one = all_files(temp / "1");
  EXPECT_EQ(one.size(), 2u + 180u + 60u);
  EXPECT_EQ(one, all_files(temp / "2"));
  EXPECT_EQ(one, all_files(temp / "7"));
}

TEST(WriteRecording, ReadingAndWritingARecordingAgainGivesTheSameBytes) {
  const TempFolder temp;
  ASSERT_TRUE(write_recording(temp / "a", many_frames(30), RunContext()));
  const auto first = Recording::open(temp / "a");
  ASSERT_TRUE(first);
  ASSERT_TRUE(write_recording(temp / "b", *first, RunContext()));
  EXPECT_EQ(all_files(temp / "a"), all_files(temp / "b"));
}

TEST(WriteRecording, CancelledLeavesNothingBehind) {
  const TempFolder temp;
  const RunContext context;
  CountingFrames sequence = many_frames(300);
  sequence.on_read = [&](std::size_t position) {
    if (position == 150) context.cancel();
  };
  const auto done = write_recording(temp / "new/r", sequence, context);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, ErrorCode::kCancelled);
  EXPECT_EQ(temp.count(), 0u);
  EXPECT_LT(sequence.reads, 270);
}

TEST(WriteRecording, CancelledBeforeTheStartReadsNothing) {
  const TempFolder temp;
  const RunContext context;
  context.cancel();
  const CountingFrames sequence = many_frames(3);
  EXPECT_EQ(write_recording(temp / "r", sequence, context).error().code, ErrorCode::kCancelled);
  EXPECT_EQ(sequence.reads, 0);
  EXPECT_EQ(temp.count(), 0u);
}

TEST(WriteRecording, FrameThatCannotBeReadLeavesNothingBehind) {
  const TempFolder temp;
  fs::create_directory(temp / "r");
  CountingFrames sequence = many_frames(100);
  sequence.broken = 70;
  const auto done = write_recording(temp / "r", sequence, RunContext());
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "frame 70 is broken");
  EXPECT_TRUE(fs::is_empty(temp / "r"));  // the empty folder was the caller's
}

TEST(WriteRecording, NeverTouchesAFolderWithContent) {
  const TempFolder temp;
  fs::create_directory(temp / "depth");
  temp.put("depth/000000.png", "mine");
  EXPECT_EQ(write_recording(temp.path(), many_frames(2), RunContext()).error().code,
            ErrorCode::kAlreadyExists);
  EXPECT_EQ(content_of(temp / "depth/000000.png"), "mine");
}

TEST(WriteRecording, TwoFramesWithOneIndexAreRefused) {
  const TempFolder temp;
  const CountingFrames sequence(small_header(), {depth_frame(3), depth_frame(3)});
  EXPECT_THAT(write_recording(temp / "r", sequence, RunContext()).error().message,
              HasSubstr("index 3"));
  EXPECT_EQ(temp.count(), 0u);
}

TEST(WriteRecording, ProgressEndsAtOne) {
  const TempFolder temp;
  const RunContext context;
  ASSERT_TRUE(write_recording(temp / "r", many_frames(20), context));
  EXPECT_EQ(context.progress().fraction, 1.0);
}

}  // namespace
}  // namespace turnscan
