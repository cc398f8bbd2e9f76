#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <turnscan/capture/recorder/recorder.hpp>

#include "tests/io/scarcity.hpp"
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

RecorderOptions without_limit() {
  RecorderOptions options;
  options.min_free_bytes = 0.0;
  return options;
}

TEST(Recorder, WritesFramesInTheOrderInWhichTheyCame) {
  const TempFolder temp;
  RecorderOptions options = without_limit();
  options.encoders = 7;
  options.queue_frames = 1000;
  auto recorder = Recorder::create(temp / "r", small_header(), {}, options);
  ASSERT_TRUE(recorder) << recorder.error().text();
  for (std::uint32_t i = 0; i < 300; ++i) {
    Frame frame = depth_frame(i);
    if (i % 3 == 0) frame.color = testing::color_image(i);
    if (i % 10 == 9) frame.info.status = FrameStatus::kDropped;
    ASSERT_TRUE(recorder->put(std::move(frame)));
  }
  ASSERT_TRUE(recorder->finish());
  const RecorderStatistics counts = recorder->statistics();
  EXPECT_EQ(counts.written, 270u);
  EXPECT_EQ(counts.dropped_by_source, 30u);
  EXPECT_EQ(counts.dropped_by_disk, 0u);
  EXPECT_GT(counts.bytes, 0u);
  EXPECT_GE(counts.most_waiting, 1u);
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording) << recording.error().text();
  EXPECT_TRUE(recording->complete());
  EXPECT_TRUE(recording->notes().empty());  // "sorted" would be one
  ASSERT_EQ(recording->frames().size(), 300u);
  for (std::uint32_t i = 0; i < 300; ++i) {
    ASSERT_EQ(recording->frames()[i].index, i);
    if (i % 10 == 9) continue;
    EXPECT_EQ(recording->read(i)->depth.pixels, depth_frame(i).depth.pixels);
  }
}

TEST(Recorder, NumberOfThreadsDoesNotChangeTheBytes) {
  const TempFolder temp;
  for (const int encoders : {1, 5}) {
    RecorderOptions options = without_limit();
    options.encoders = encoders;
    options.queue_frames = 1000;
    auto recorder = Recorder::create(temp / std::to_string(encoders), small_header(), {}, options);
    for (std::uint32_t i = 0; i < 60; ++i) ASSERT_TRUE(recorder->put(depth_frame(i)));
    ASSERT_TRUE(recorder->finish());
  }
  EXPECT_EQ(content_of(temp / "1/frames.csv"), content_of(temp / "5/frames.csv"));
  EXPECT_EQ(content_of(temp / "1/depth/000059.png"), content_of(temp / "5/depth/000059.png"));
}

TEST(Recorder, WritesJpegFilesOfTheQualityThatWasAskedFor) {
  const TempFolder temp;
  Frame frame = depth_frame(0);
  frame.color = ColorImage(8, 6);
  for (std::size_t i = 0; i < frame.color.pixels.size(); ++i) {
    const auto grey = std::uint8_t(i * 37);
    frame.color.pixels[i] = {grey, grey, grey};
  }
  std::vector<std::uintmax_t> sizes;
  std::vector<double> errors;
  for (const int quality : {10, 95}) {
    RecorderOptions options = without_limit();
    options.color = ColorFileFormat::kJpeg;
    options.color_quality = quality;
    const fs::path folder = temp / std::to_string(quality);
    auto recorder = Recorder::create(folder, small_header(), {}, options);
    ASSERT_TRUE(recorder) << recorder.error().text();
    ASSERT_TRUE(recorder->put(frame));
    ASSERT_TRUE(recorder->finish());
    sizes.push_back(fs::file_size(folder / "color/000000.jpg"));
    const ColorImage back = Recording::open(folder)->read(0)->color;
    double error = 0.0;
    for (std::size_t i = 0; i < back.pixels.size(); ++i)
      error += std::abs(back.pixels[i].g - frame.color.pixels[i].g);
    errors.push_back(error);
  }
  EXPECT_LT(sizes[0], sizes[1]);
  EXPECT_GT(errors[0], 2.0 * errors[1]);
  RecorderOptions none = without_limit();
  none.color_quality = 0;
  EXPECT_EQ(Recorder::create(temp / "r", small_header(), {}, none).error().code,
            ErrorCode::kInvalidOption);
}

TEST(Recorder, WhatTheDiskCannotTakeBecomesDroppedLines) {
  const TempFolder temp;
  RecorderOptions options = without_limit();
  options.encoders = 1;
  options.queue_frames = 1;
  SequenceHeader header = small_header();
  header.sensors[0].intrinsics.width = 640;
  header.sensors[0].intrinsics.height = 480;
  auto recorder = Recorder::create(temp / "r", header, {}, options);
  ASSERT_TRUE(recorder);
  Frame frame = depth_frame(0);
  frame.depth = DepthImage(640, 480, 1000);
  for (std::uint32_t i = 0; i < 50; ++i) {
    frame.info.index = i;
    ASSERT_TRUE(recorder->put(frame));
  }
  ASSERT_TRUE(recorder->finish());
  const RecorderStatistics counts = recorder->statistics();
  EXPECT_GT(counts.dropped_by_disk, 0u);
  EXPECT_EQ(counts.written + counts.dropped_by_disk, 50u);
  const auto recording = Recording::open(temp / "r");
  ASSERT_EQ(recording->frames().size(), 50u);
  std::uint64_t dropped = 0;
  for (const FrameInfo& info : recording->frames())
    dropped += info.status == FrameStatus::kDropped ? 1 : 0;
  EXPECT_EQ(dropped, counts.dropped_by_disk);
}

TEST(Recorder, NothingIsDroppedWhenTheCallerWaitsForRoom) {
  const TempFolder temp;
  RecorderOptions options = without_limit();
  options.queue_frames = 1;
  auto recorder = Recorder::create(temp / "r", small_header(), {}, options);
  for (std::uint32_t i = 0; i < 100; ++i) {
    recorder->wait_for_room();
    ASSERT_TRUE(recorder->put(depth_frame(i)));
  }
  ASSERT_TRUE(recorder->finish());
  EXPECT_EQ(recorder->statistics().written, 100u);
}

TEST(Recorder, FullDiskFailsOnceAndLeavesAReadableRecording) {
  const TempFolder temp;
  auto recorder = Recorder::create(temp / "r", small_header(), {}, without_limit());
  ASSERT_TRUE(recorder);
  Result<> done;
  {
    const testing::FullDisk full(600);
    for (std::uint32_t i = 0; i < 100000 && (done = recorder->put(depth_frame(i))); ++i)
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::kIo);
  }
  ASSERT_TRUE(recorder->finish());
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording) << recording.error().text();
  EXPECT_TRUE(recording->complete());
  EXPECT_EQ(recording->frames().size(), recorder->statistics().written);
  EXPECT_GT(recording->frames().size(), 0u);
}

TEST(Recorder, RefusesADiskWithTooLittleSpaceAndMakesNothing) {
  const TempFolder temp;
  RecorderOptions options;
  options.min_free_bytes = 1e15;
  const auto recorder = Recorder::create(temp / "r", small_header(), {}, options);
  ASSERT_FALSE(recorder);
  EXPECT_EQ(recorder.error().code, ErrorCode::kIo);
  EXPECT_THAT(recorder.error().message, HasSubstr("MB are free"));
  EXPECT_FALSE(fs::exists(temp / "r"));
  EXPECT_FALSE(Recorder::create(temp / "r", small_header(), {}, without_limit(), 1e18));
}

TEST(Recorder, RefusesIndicesThatDoNotGrow) {
  const TempFolder temp;
  auto recorder = Recorder::create(temp / "r", small_header(), {}, without_limit());
  ASSERT_TRUE(recorder->put(depth_frame(4)));
  EXPECT_EQ(recorder->put(depth_frame(4)).error().code, ErrorCode::kInvalidOption);
  EXPECT_TRUE(recorder->put(depth_frame(6)));
}

TEST(Recorder, WithoutFinishTheRecordingIsIncompleteAndReadable) {
  const TempFolder temp;
  {
    auto recorder = Recorder::create(temp / "r", small_header(), {}, without_limit());
    for (std::uint32_t i = 0; i < 20; ++i) ASSERT_TRUE(recorder->put(depth_frame(i)));
  }
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording);
  EXPECT_FALSE(recording->complete());
}

TEST(Recorder, WritesAtTheEndWhatWasNotKnownAtTheStart) {
  const TempFolder temp;
  auto recorder = Recorder::create(temp / "r", small_header(), {}, without_limit());
  SequenceHeader header = small_header();
  header.turntable.emplace();
  header.turntable->speed_rad_s = 0.25;
  recorder->describe(header, {{"ended", "after one turn"}});
  ASSERT_TRUE(recorder->finish());
  const auto recording = Recording::open(temp / "r");
  ASSERT_TRUE(recording);
  EXPECT_EQ(recording->header().turntable->speed_rad_s, 0.25);
  EXPECT_EQ(recording->capture_settings().at("ended"), "after one turn");
}

TEST(Recorder, NeverOverwrites) {
  const TempFolder temp;
  { auto first = Recorder::create(temp / "r", small_header(), {}, without_limit()); }
  EXPECT_EQ(Recorder::create(temp / "r", small_header(), {}, without_limit()).error().code,
            ErrorCode::kAlreadyExists);
}

TEST(Recorder, ChecksEveryOption) {
  const TempFolder temp;
  RecorderOptions a, b, c;
  a.queue_frames = 0;
  b.encoders = 0;
  c.min_free_bytes = -1.0;
  for (const RecorderOptions& options : {a, b, c})
    EXPECT_EQ(Recorder::create(temp / "r", small_header(), {}, options).error().code,
              ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
