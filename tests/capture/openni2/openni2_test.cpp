// The driver for OpenNI 2 as it is: on the dummy device that OpenNI brings, on a sensor of the
// tests, and on files that OpenNI's own recorder has made of it.

#include <gtest/gtest.h>

#ifdef TURNSCAN_OPENNI2

#include <sys/stat.h>
#include <cmath>
#include <turnscan/capture/source/plugins.hpp>

#include "tests/capture/openni2/recorded_film.hpp"
#include "tests/capture/taking.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::allow_frames;
using testing::Film;
using testing::film_uri;
using testing::opened;
using testing::record_oni;
using testing::Taken;
using testing::TempFolder;
using testing::uri_of;

/// The frames of a film, none of which comes before the one before it was taken.
Taken watch(FrameSource& source, int count) {
  Taken all;
  EXPECT_TRUE(source.start());
  for (int i = 0; i < count && !all.error; ++i) {
    allow_frames(1);
    Taken one = testing::take_all(source, 1);
    for (Frame& frame : one.frames) all.frames.push_back(std::move(frame));
    all.error = one.error;
  }
  return all;
}

/// A small film of no meaning: every pixel tells its place and frame.
Film counting_film(int count) {
  Film film;
  film.header.width = 16;
  film.header.height = 12;
  for (int i = 0; i < count; ++i) {
    film.depth.emplace_back();
    for (int k = 0; k < 192; ++k)
      film.depth.back().push_back(static_cast<std::uint16_t>(5000 + 200 * i + k));
    film.depth.back()[5] = 0;
    film.color.emplace_back(576, static_cast<std::uint8_t>(10 * i + 1));
  }
  return film;
}

/// The dummy's first line is two metres away; below it moves a ball of a known slope.
void expect_dummy(const Frame& frame) {
  ASSERT_EQ(frame.info.status, FrameStatus::kOk);
  for (int x = 0; x < 320; ++x) EXPECT_EQ(frame.depth.at(x, 0), 2000);
  int ball = 0;
  for (int y = 1; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      if (frame.depth.at(x, y) == 0) continue;
      // 1000 + 3 (x - y), about the ball's middle, which moves on the image's diagonal.
      EXPECT_NEAR(frame.depth.at(x, y), 1000, 3 * 320);
      ++ball;
    }
  EXPECT_GT(ball, 20);
}

TEST(OpenNi2, TakesFramesFromTheDummyDevice) {
  const auto source = opened("openni2:Dummy?hfov=58");
  ASSERT_TRUE(source);
  const SourceInfo& info = source->info();
  EXPECT_TRUE(info.live);
  EXPECT_EQ(info.fps, 30.0);
  EXPECT_EQ(info.header.sensors[0].depth_unit_m, 1e-3);
  EXPECT_EQ(info.header.sensors[0].intrinsics.width, 320);
  EXPECT_NEAR(info.header.sensors[0].intrinsics.fx, 288.647, 1e-3);
  ASSERT_TRUE(source->start());
  const Taken taken = testing::take_all(*source, 4);
  EXPECT_FALSE(taken.error);
  ASSERT_EQ(taken.frames.size(), 4u);
  double last_s = 0.0;
  for (const Frame& frame : taken.frames) {
    if (frame.info.status == FrameStatus::kDropped) continue;  // a slow machine
    expect_dummy(frame);
    EXPECT_GT(frame.info.time_s, last_s);
    last_s = frame.info.time_s;
  }
}

TEST(OpenNi2, SaysWhatItNeedsOrWhatIsNotThere) {
  const TempFolder folder;
  const auto narrow = open_source("openni2:Dummy", {});
  ASSERT_FALSE(narrow);
  EXPECT_EQ(narrow.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(narrow.error().message.find("hfov=DEGREES"), std::string::npos);
  EXPECT_EQ(open_source("openni2:nowhere.oni", {}).error().code, ErrorCode::kNotFound);
  const std::string damaged = folder.put("damaged.oni", "this is no film").string();
  EXPECT_EQ(open_source("openni2:" + damaged, {}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(open_source("openni2:Dummy?hfov=200", {}).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(open_source("openni2:Dummy?hfov=58&color=1", {}).error().code, ErrorCode::kUnsupported);
  EXPECT_EQ(open_source("openni2:Dummy?hfov=58&mode=1x1@1", {}).error().code,
            ErrorCode::kInvalidOption);
}

// The texts are those of OpenNI's drivers for PrimeSense and Orbbec sensors on Linux: they cannot
// open what the user may not, and cannot claim the interface of what another program has.
TEST(OpenNi2, APipeIsNoFileToPlay) {
  const testing::TempFolder temp;
  ASSERT_EQ(::mkfifo((temp / "a.oni").c_str(), 0600), 0);
  const auto source = open_source(uri_of((temp / "a.oni").string()), {});
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kNotFound);
}

TEST(OpenNi2, ASensorThatCannotBeOpenedSaysWhy) {
  const std::vector<std::tuple<std::string, ErrorCode, std::string>> cases{
      {"Could not open \"1d27/0601@3/2\": Failed to open the USB device!", ErrorCode::kNoPermission,
       "udev rule"},
      {"Could not open \"1d27/0601@3/2\": Failed to set USB interface!", ErrorCode::kDeviceBusy,
       "another program"},
      {"A device is already opened!", ErrorCode::kDeviceBusy, "another program"},
      {"Could not open \"1d27/0601@3/2\": USB device not found!", ErrorCode::kDeviceLost, "cable"},
      {"Could not open \"1d27/0601@3/2\": USB transfer timeout!", ErrorCode::kLibrary,
       "plug the sensor in again"}};
  for (const auto& [text, code, says] : cases) {
    const auto source = open_source(uri_of("test:refuse:" + text), {});
    ASSERT_FALSE(source) << text;
    EXPECT_EQ(source.error().code, code) << source.error().text();
    EXPECT_NE(source.error().message.find(says), std::string::npos) << source.error().text();
    EXPECT_EQ(source.error().message.find('\n'), std::string::npos);
  }
}

TEST(OpenNi2, ASensorsFramesComeBitByBitInItsFinerUnit) {
  const TempFolder folder;
  Film film = counting_film(3);
  film.write(folder / "film");
  const auto source = opened(film_uri(folder / "film"));
  ASSERT_TRUE(source);
  EXPECT_EQ(source->info().identities, std::vector<std::string>{"openni2-Film-T-1"});
  const SensorInfo& sensor = source->info().header.sensors[0];
  EXPECT_EQ(sensor.depth_unit_m, 1e-4);
  EXPECT_NEAR(sensor.intrinsics.fx, 8.0 / std::tan(0.5), 1e-5);
  EXPECT_NEAR(sensor.intrinsics.fy, 6.0 / std::tan(0.4), 1e-5);
  const Taken taken = watch(*source, 3);
  ASSERT_FALSE(taken.error) << taken.error->text();
  ASSERT_EQ(taken.frames.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(taken.frames[i].depth.pixels, film.depth[i]);
    EXPECT_NEAR(taken.frames[i].info.time_s, double(i) / 30.0, 1e-6);
    EXPECT_TRUE(taken.frames[i].color.pixels.empty());
  }
}

TEST(OpenNi2, ColoursComeWithTheDepthOfTheSameMoment) {
  const TempFolder folder;
  Film film = counting_film(4);
  film.header.color = 1;
  film.write(folder / "film");
  const auto source = opened(film_uri(folder / "film", {{"color", "1"}}));
  ASSERT_TRUE(source);
  const Taken taken = watch(*source, 4);
  ASSERT_EQ(taken.frames.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_EQ(taken.frames[i].color.pixels.size(), 192u) << i;
    EXPECT_EQ(taken.frames[i].color.at(7, 3).g, film.color[i][0]);
  }
}

TEST(OpenNi2, ASensorThatIsUnpluggedWhileItShowsFramesIsLost) {
  const TempFolder folder;
  Film film = counting_film(5);
  film.header.unplugged_after = 2;
  film.write(folder / "film");
  const auto source = opened(film_uri(folder / "film"));
  ASSERT_TRUE(source);
  const Taken taken = watch(*source, 3);
  // OpenNI may tell of the loss before the last frame is taken from it.
  EXPECT_LE(taken.frames.size(), 2u);
  ASSERT_TRUE(taken.error);
  EXPECT_EQ(taken.error->code, ErrorCode::kDeviceLost);
  EXPECT_NE(taken.error->message.find("cable"), std::string::npos);
}

TEST(OpenNi2, AnOniFileGivesTheFramesOfTheSensorThatItRecorded) {
  const TempFolder folder;
  Film film = counting_film(6);
  film.write(folder / "film");
  record_oni(folder / "film", 6, folder / "film.oni");
  for (const char* speed : {"max", "1"}) {
    const auto source = opened(uri_of((folder / "film.oni").string(), {{"speed", speed}}));
    ASSERT_TRUE(source);
    const SourceInfo& info = source->info();
    EXPECT_EQ(info.live, speed == std::string("1"));
    EXPECT_EQ(info.frame_count, 6u);
    EXPECT_EQ(info.header.sensors[0].depth_unit_m, 1e-4);
    EXPECT_NEAR(info.header.sensors[0].intrinsics.fx, 8.0 / std::tan(0.5), 1e-5);
    const Taken taken = testing::run(*source);
    EXPECT_FALSE(taken.error) << taken.error->text();
    std::size_t shown = 0;
    for (const Frame& frame : taken.frames) {
      if (frame.info.status == FrameStatus::kDropped) continue;  // in real time, a slow machine
      const auto i = static_cast<std::size_t>(std::lround(frame.info.time_s * 30.0));
      ASSERT_LT(i, 6u);
      EXPECT_EQ(frame.depth.pixels, film.depth[i]);
      ++shown;
    }
    EXPECT_EQ(shown, info.live ? shown : 6u);
  }
}

}  // namespace
}  // namespace turnscan

#endif
