#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <thread>
#include <turnscan/capture/session/capture.hpp>

#include "tests/capture/simulated_table.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using ::testing::HasSubstr;
using testing::TempFolder;

constexpr double kDeg = std::numbers::pi / 180.0;

// Small and quick to render; 15 frames a turn.
const std::string kSmall =
    "virtual:letter-a?sensor=kinect-v1&distance=3m&fps=30&prepared=15&speed=720deg/s";

struct Recorded {
  Result<CaptureResult> result;
  std::optional<Recording> recording;
};

CaptureOptions plain() {
  CaptureOptions options;
  options.recorder.min_free_bytes = 0.0;
  options.recorder.queue_frames = 10000;
  return options;
}

Recorded record(const std::string& uri, const std::filesystem::path& folder,
                const CaptureOptions& options, const CaptureHooks& hooks = {},
                const RunContext& context = {}) {
  Recorded run;
  auto source = open_source(uri, {});
  if (!source) {
    run.result = tl::unexpected<Error>(source.error());
    return run;
  }
  EXPECT_TRUE((*source)->start());
  run.result = capture(**source, folder, (*source)->info().header, {}, options, hooks, context);
  if (auto opened = Recording::open(folder)) run.recording.emplace(std::move(*opened));
  return run;
}

TEST(Capture, EndsAfterTheTurnsThatTheFramesAnglesSay) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.limits.turns = 2.0;
  options.limits.overlap_rad = 0.0;
  const Recorded run = record(kSmall + "&angles=1&calibration=true", temp / "r", options);
  ASSERT_TRUE(run.result) << run.result.error().text();
  EXPECT_FALSE(run.result->error);
  EXPECT_EQ(run.result->turns_found, "angles of the frames");
  ASSERT_TRUE(run.recording);
  EXPECT_TRUE(run.recording->complete());
  EXPECT_NEAR(double(run.recording->frames().size()), 31.0, 1.0);
  EXPECT_EQ(run.recording->frames()[0].angle_rad, 0.0);
  EXPECT_TRUE(run.recording->header().turntable);
}

TEST(Capture, EndsAfterTheTurnsThatAStatedSpeedGives) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.speed_rad_s = -720.0 * kDeg;
  options.limits.turns = 1.0;
  options.limits.overlap_rad = 24.0 * kDeg;
  const Recorded run = record(kSmall, temp / "r", options);
  ASSERT_TRUE(run.result);
  EXPECT_EQ(run.result->turns_found, "stated speed");
  EXPECT_NEAR(double(run.recording->frames().size()), 17.0, 1.0);
}

TEST(Capture, EndsAfterSecondsOrFrames) {
  const TempFolder temp;
  CaptureOptions seconds = plain(), frames = plain();
  seconds.limits.seconds = 0.5;
  frames.limits.frames = 7;
  EXPECT_NEAR(double(record(kSmall, temp / "s", seconds).recording->frames().size()), 16.0, 1.0);
  EXPECT_EQ(record(kSmall, temp / "f", frames).recording->frames().size(), 7u);
}

TEST(Capture, EndsWhenItIsStoppedAndKeepsEverything) {
  const TempFolder temp;
  for (const bool meant : {true, false}) {
    const RunContext context;
    CaptureOptions options = plain();
    if (meant) options.limits.until_stopped = true;
    if (!meant) options.limits.seconds = 1000.0;
    CaptureHooks hooks;
    hooks.progress = [&](const CaptureProgress& progress) {
      if (progress.seconds > 0.6) context.cancel();
    };
    const Recorded run = record(kSmall, temp / (meant ? "a" : "b"), options, hooks, context);
    ASSERT_TRUE(run.result);
    EXPECT_EQ(run.result->error.has_value(), !meant);
    if (!meant) {
      EXPECT_EQ(run.result->error->code, ErrorCode::kCancelled);
    }
    ASSERT_TRUE(run.recording);
    EXPECT_TRUE(run.recording->complete());
    EXPECT_GT(run.recording->frames().size(), 15u);
  }
}

TEST(Capture, ADeviceThatVanishesLeavesACompleteRecording) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.limits.seconds = 5.0;
  const Recorded run = record(kSmall + "&fault=lost@1s", temp / "r", options);
  ASSERT_TRUE(run.result);
  ASSERT_TRUE(run.result->error);
  EXPECT_EQ(run.result->error->code, ErrorCode::kDeviceLost);
  EXPECT_TRUE(run.recording->complete());
  EXPECT_EQ(run.recording->frames().size(), 30u);
}

TEST(Capture, FramesThatAreWrongBecomeDroppedLines) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.limits.frames = 20;
  const Recorded run =
      record(kSmall + "&fault=size@0.1s,backwards@0.3s,gap@0.5s", temp / "r", options);
  ASSERT_TRUE(run.result);
  EXPECT_FALSE(run.result->error);
  ASSERT_EQ(run.recording->frames().size(), 20u);
  std::size_t dropped = 0;
  for (const FrameInfo& info : run.recording->frames())
    dropped += info.status == FrameStatus::kDropped ? 1 : 0;
  EXPECT_EQ(dropped, 3u);
  EXPECT_EQ(run.result->recorder.dropped_by_source, 3u);
}

TEST(Capture, ASensorThatFallsSilentIsLostAfterTheTimeout) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.limits.seconds = 100.0;
  options.limits.device_timeout_s = 0.3;
  const Recorded run = record(kSmall + "&realtime=1&fault=stall@0.2s+60s", temp / "r", options);
  ASSERT_TRUE(run.result);
  ASSERT_TRUE(run.result->error);
  EXPECT_EQ(run.result->error->code, ErrorCode::kDeviceLost);
  EXPECT_THAT(run.result->error->message, HasSubstr("no frame came"));
  EXPECT_TRUE(run.recording->complete());
}

TEST(Capture, AShortStallIsSurvivedAndTold) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.limits.seconds = 1.2;
  const Recorded run = record(kSmall + "&realtime=1&fault=stall@0.3s+0.5s", temp / "r", options);
  ASSERT_TRUE(run.result);
  EXPECT_FALSE(run.result->error);
  EXPECT_GT(run.result->longest_gap_s, 0.4);
}

TEST(Capture, CroppedFramesKeepThePlatterAndSayWhatIsBehind) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.limits.frames = 3;
  options.crop.enabled = true;
  const std::string room = kSmall + "&calibration=true&angles=1&room=wall&platter-radius=0.15m";
  auto source = open_source(room, {});
  ASSERT_TRUE(source) << source.error().text();
  SequenceHeader header = (*source)->info().header;
  ASSERT_TRUE(header.turntable);
  header.turntable->radius_m = 0.15;
  ASSERT_TRUE((*source)->start());
  const auto result = capture(**source, temp / "r", header, {}, options, {}, {});
  ASSERT_TRUE(result) << result.error().text();
  const auto recording = Recording::open(temp / "r");
  const Frame frame = *recording->read(1);
  std::size_t kept = 0, outside = 0;
  for (const std::uint16_t raw : frame.depth.pixels) {
    kept += raw != kNoReturn && raw != kOutsideCrop ? 1 : 0;
    outside += raw == kOutsideCrop ? 1 : 0;
  }
  EXPECT_GT(kept, 100u);
  EXPECT_GT(outside, kept);
}

TEST(Capture, RefusesWhatContradictsItself) {
  const TempFolder temp;
  CaptureOptions both = plain(), crop = plain(), stops = plain();
  both.limits.turns = 1.0;
  both.limits.frames = 3;
  crop.crop.enabled = true;
  stops.stops.stops = 8;
  for (const CaptureOptions& options : {both, crop, stops}) {
    const Recorded run = record(kSmall, temp / "r", options);
    ASSERT_FALSE(run.result);
    EXPECT_EQ(run.result.error().code, ErrorCode::kInvalidOption);
  }
  EXPECT_FALSE(std::filesystem::exists(temp / "r"));
}

TEST(Capture, ChecksEveryOption) {
  CaptureOptions o;
  for (const auto& [name, value] :
       std::initializer_list<std::pair<const char*, const char*>>{{"turns", "0"},
                                                                  {"seconds", "0"},
                                                                  {"frames", "0"},
                                                                  {"overlap", "400deg"},
                                                                  {"device-timeout", "0s"}})
    EXPECT_FALSE(describe(o.limits).set(name, value)) << name;
  for (const char* name : {"crop-below", "crop-beyond", "crop-height"})
    EXPECT_FALSE(describe(o.crop).set(name, "20m")) << name;
  for (const auto& [name, value] : std::initializer_list<std::pair<const char*, const char*>>{
           {"stops", "1"}, {"stop-frames", "0"}, {"settle", "-1s"}})
    EXPECT_FALSE(describe(o.stops).set(name, value)) << name;
}

TEST(Capture, AMotorTurnsTheTableWhileFramesAreTakenAndStandsAfterwards) {
  const TempFolder temp;
  testing::SimulatedTable table(testing::BoardKind::kText, testing::BoardFault::kNone);
  MotorOptions quick;
  quick.boot_s = 0.02;
  auto motor = Motor::open(table.port(), quick, {});
  ASSERT_TRUE(motor);
  CaptureOptions options = plain();
  options.speed_rad_s = 45.0 * kDeg;
  options.motor_ramp_s = 0.1;
  options.limits.seconds = 1.0;
  CaptureHooks hooks;
  hooks.motor = &*motor;
  const Recorded run = record(kSmall + "&realtime=1", temp / "r", options, hooks);
  ASSERT_TRUE(run.result) << run.result.error().text();
  EXPECT_FALSE(run.result->error);
  EXPECT_TRUE(table.was_told_to_turn());
  EXPECT_FALSE(table.turning());
  const auto& last = run.recording->frames().back();
  EXPECT_NEAR(*last.angle_rad, 45.0 * kDeg * (last.time_s - run.recording->frames()[0].time_s),
              1e-9);
}

TEST(Capture, AMotorThatFailsEndsTheRecordingWhichIsComplete) {
  const TempFolder temp;
  testing::SimulatedTable table(testing::BoardKind::kText, testing::BoardFault::kStops);
  MotorOptions quick;
  quick.boot_s = 0.02;
  auto motor = Motor::open(table.port(), quick, {});
  CaptureOptions options = plain();
  options.speed_rad_s = 45.0 * kDeg;
  options.motor_ramp_s = 0.05;
  options.limits.seconds = 20.0;
  CaptureHooks hooks;
  hooks.motor = &*motor;
  const Recorded run = record(kSmall + "&realtime=1", temp / "r", options, hooks);
  ASSERT_TRUE(run.result);
  ASSERT_TRUE(run.result->error);
  EXPECT_THAT(run.result->error->message, HasSubstr("stopped by itself"));
  EXPECT_TRUE(run.recording->complete());
}

TEST(Capture, StopAndGoRecordsOneMeanFrameAtEachStop) {
  const TempFolder temp;
  testing::SimulatedTable table(testing::BoardKind::kGrbl, testing::BoardFault::kNone);
  MotorOptions quick;
  quick.boot_s = 0.02;
  auto motor = Motor::open(table.port(), quick, {});
  CaptureOptions options = plain();
  options.speed_rad_s = 85.0 * kDeg;
  options.stops.stops = 12;
  options.stops.averaged = 2;
  options.stops.settle_s = 0.05;
  options.limits.turns = 0.25;
  CaptureHooks hooks;
  hooks.motor = &*motor;
  const Recorded run = record(kSmall, temp / "r", options, hooks);
  ASSERT_TRUE(run.result);
  EXPECT_FALSE(run.result->error) << run.result->error->text();
  ASSERT_EQ(run.recording->frames().size(), 3u);
  EXPECT_NEAR(*run.recording->frames()[2].angle_rad, 60.0 * kDeg, 1e-9);
  EXPECT_NEAR(table.angle_deg(), 60.0, 0.1);
}

TEST(Capture, AddsAPassBehindThoseOfARecording) {
  const TempFolder temp;
  CaptureOptions options = plain();
  options.limits.frames = 5;
  const std::string uri = kSmall + "&angles=1&calibration=true";
  ASSERT_TRUE(record(uri, temp / "r", options).recording);
  options.add_pass = true;
  options.limits.frames = 3;
  const Recorded run = record(uri, temp / "r", options);
  ASSERT_TRUE(run.result) << run.result.error().text();
  EXPECT_EQ(run.result->recorder.written, 3u);
  ASSERT_TRUE(run.recording);
  EXPECT_TRUE(run.recording->complete());
  ASSERT_EQ(run.recording->frames().size(), 8u);
  for (std::uint32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(run.recording->frames()[i].index, i);
    EXPECT_EQ(run.recording->frames()[i].pass, i < 5 ? 0u : 1u);
  }
  EXPECT_EQ(run.recording->frames()[5].angle_rad, 0.0);
  EXPECT_EQ(run.recording->capture_settings().at("ended"), "as it was meant to");
  EXPECT_EQ(run.recording->capture_settings().at("pass_1_ended"), "as it was meant to");
  const Recorded other =
      record("virtual:letter-a?sensor=kinect-v2&prepared=2", temp / "r", options);
  ASSERT_FALSE(other.result);
  EXPECT_THAT(other.result.error().message, HasSubstr("other sensors"));
  EXPECT_FALSE(record(uri, temp / "none", options).result);
}

TEST(MeanFrame, IsTheMeanOfTheReturnsWhereHalfOfTheFramesHaveOne) {
  std::vector<Frame> frames(4);
  for (Frame& frame : frames) frame.depth = DepthImage(3, 1);
  const std::uint16_t values[4][3] = {
      {100, 0, 500}, {101, 0, kOutsideCrop}, {103, 7, 502}, {104, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k) frames[i].depth.pixels[k] = values[i][k];
  EXPECT_EQ(mean_frame(frames).depth.pixels, (std::vector<std::uint16_t>{102, 0, 501}));
}

}  // namespace
}  // namespace turnscan
