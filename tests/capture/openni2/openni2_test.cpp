// The driver for OpenNI 2 as it is: on the dummy device that OpenNI brings, on a sensor of the
// tests, and on files that OpenNI's own recorder has made of it.

#include <gtest/gtest.h>

#ifdef TURNSCAN_OPENNI2

#include <OpenNI.h>
#include <dlfcn.h>

#include <fmt/format.h>
#include <sys/stat.h>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>
#include <turnscan/capture/source/plugins.hpp>
#include <turnscan/capture/source/source_uri.hpp>

#include "tests/capture/doll_mesh.hpp"
#include "tests/capture/openni2/film.hpp"
#include "tests/capture/taking.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using testing::Film;
using testing::opened;
using testing::Taken;
using testing::TempFolder;

std::string uri_of(const std::string& address,
                   const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  return format_source_uri({"openni2", address, parameters});
}

std::string film_uri(const std::filesystem::path& file,
                     const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  return uri_of("test:film:" + file.string(), parameters);
}

/// Of the driver of the tests, once OpenNI has loaded it.
void allow_frames(int count) {
  void* const driver = dlopen(TURNSCAN_OPENNI2_DRIVER, RTLD_NOW | RTLD_NOLOAD);
  ASSERT_NE(driver, nullptr) << dlerror();
  const auto allow = reinterpret_cast<testing::AllowFrames>(dlsym(driver, testing::kAllowFrames));
  dlclose(driver);
  ASSERT_NE(allow, nullptr);
  allow(count);
}

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

Film film_of(const std::vector<Frame>& frames, int fps) {
  Film film;
  film.header.width = frames.at(0).depth.width;
  film.header.height = frames[0].depth.height;
  film.header.fps = fps;
  for (const Frame& frame : frames) film.depth.push_back(frame.depth.pixels);
  return film;
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

/// Plays the film and has OpenNI record it. The recorder begins at some time of its own after it
/// was told to, so that it may miss frames: then it is given more time.
void record_oni(const std::filesystem::path& film, int count, const std::filesystem::path& oni) {
  ASSERT_EQ(openni::OpenNI::initialize(), openni::STATUS_OK);
  const std::string address = "test:film:" + film.string();
  for (int pause_ms = 20; pause_ms < 10000; pause_ms *= 3) {
    openni::Device device;
    openni::VideoStream stream;
    ASSERT_EQ(device.open(address.c_str()), openni::STATUS_OK);
    ASSERT_EQ(stream.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
    openni::VideoMode mode = stream.getVideoMode();
    mode.setPixelFormat(openni::PIXEL_FORMAT_DEPTH_100_UM);
    ASSERT_EQ(stream.setVideoMode(mode), openni::STATUS_OK);
    openni::Recorder recorder;
    ASSERT_EQ(recorder.create(oni.c_str()), openni::STATUS_OK);
    ASSERT_EQ(recorder.attach(stream), openni::STATUS_OK);
    ASSERT_EQ(recorder.start(), openni::STATUS_OK);
    ASSERT_EQ(stream.start(), openni::STATUS_OK);
    std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms));
    for (int i = 0; i < count; ++i) {
      allow_frames(1);
      openni::VideoFrameRef frame;
      ASSERT_EQ(stream.readFrame(&frame), openni::STATUS_OK);
    }
    recorder.stop();
    recorder.destroy();
    stream.stop();
    stream.destroy();
    device.close();
    const auto played = open_source(uri_of(oni.string()), {});
    if (played && (*played)->info().frame_count == std::uint64_t(count)) return;
  }
  FAIL() << "OpenNI's recorder never began in time";
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

/// The camera that OpenNI tells of a sensor with these angles of view, as a file of the simulator.
std::filesystem::path scanner_file(const std::filesystem::path& folder, Film& film) {
  constexpr int kWidth = 192, kHeight = 144;
  film.header.hfov_rad = 0.6F;
  film.header.vfov_rad = 0.46F;
  const auto focal = [](int size, float angle) {
    return 0.5 * size / std::tan(0.5 * static_cast<double>(angle));
  };
  std::filesystem::path file = folder / "small.toml";
  std::ofstream(file) << fmt::format(
      "columns = {}\nrows = {}\nfx = {}\nfy = {}\ncx = {:.1f}\ncy = {:.1f}\nnear = \"0.3m\"\n"
      "far = \"4m\"\n",
      kWidth, kHeight, focal(kWidth, film.header.hfov_rad), focal(kHeight, film.header.vfov_rad),
      0.5 * (kWidth - 1), 0.5 * (kHeight - 1));
  return file;
}

TEST(OpenNi2, TheDollFromAnOniFileIsTheMeshOfTheSameFramesTakenDirectly) {
  constexpr double kSpeed_rad_s = 2.0 * std::numbers::pi / 1.2;  // 30 frames a turn
  const TempFolder folder;
  Film film;
  const auto sensor = opened(
      "virtual:doll?frames=30&turns=1&fps=25&distance=0.7m&calibration=true"
      "&sensor=" +
      scanner_file(folder.path(), film).string());
  ASSERT_TRUE(sensor);
  const Taken direct = testing::run(*sensor);
  ASSERT_EQ(direct.frames.size(), 30u);
  const testing::FilmHeader angles = film.header;
  film = film_of(direct.frames, 25);
  film.header.hfov_rad = angles.hfov_rad;
  film.header.vfov_rad = angles.vfov_rad;
  film.write(folder / "film");
  record_oni(folder / "film", 30, folder / "doll.oni");
  const auto source = opened(uri_of((folder / "doll.oni").string()));
  ASSERT_TRUE(source);
  const Taken played = testing::run(*source);
  ASSERT_EQ(played.frames.size(), 30u);
  const SequenceHeader& rig = sensor->info().header;
  const TriangleMesh mesh = testing::mesh_of(direct.frames, rig.sensors[0], rig, kSpeed_rad_s);
  const TriangleMesh same =
      testing::mesh_of(played.frames, source->info().header.sensors[0], rig, kSpeed_rad_s);
  EXPECT_GT(mesh.triangles.size(), 1000u);
  EXPECT_EQ(same.triangles, mesh.triangles);
  ASSERT_EQ(same.vertices.size(), mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_LT((same.vertices[i] - mesh.vertices[i]).norm(), 1e-6f);
}

}  // namespace
}  // namespace turnscan

#endif
