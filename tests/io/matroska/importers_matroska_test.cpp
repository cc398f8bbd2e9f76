// Recordings of an Azure Kinect, written by libmatroska.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <turnscan/core/random.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers.hpp>

#include "tests/io/matroska/k4a_take.hpp"
#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

using ::testing::HasSubstr;
using testing::K4aTake;
using testing::TempFolder;

DepthImage noise_image(int width, int height, std::uint64_t seed) {
  DepthImage image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = std::uint16_t(500 + mix64(seed * 1000003 + i) % 3000);
  return image;
}

/// A few small images, 30 a second.
K4aTake small_take(int frames = 4) {
  K4aTake take;
  for (int i = 0; i < frames; ++i)
    take.add_depth(0.336277 + i / 30.0, noise_image(take.width, take.height, std::uint64_t(i)));
  return take;
}

std::unique_ptr<FrameSequence> opened(const std::filesystem::path& path,
                                      const ImportOptions& options = {}) {
  auto sequence = open_foreign(path, options);
  EXPECT_TRUE(sequence) << (sequence ? "" : sequence.error().text());
  return sequence ? std::move(*sequence) : nullptr;
}

std::unique_ptr<FrameSequence> opened(const TempFolder& folder, const K4aTake& take,
                                      const ImportOptions& options = {}) {
  take.write(folder / "take.mkv");
  return opened(folder / "take.mkv", options);
}

Error refused(const TempFolder& folder, const K4aTake& take) {
  take.write(folder / "take.mkv");
  const auto sequence = open_foreign(folder / "take.mkv", {});
  EXPECT_FALSE(sequence);
  return sequence ? Error{} : sequence.error();
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream out;
  out << in.rdbuf();
  return out.str();
}

TEST(MatroskaImport, GivesTheDepthsTimesAndModelOfTheFile) {
  const TempFolder folder;
  for (const bool groups : {false, true}) {
    K4aTake take = small_take();
    take.block_groups = groups;
    take.cues = !groups;
    const auto sequence = opened(folder, take);
    ASSERT_TRUE(sequence);
    const SensorInfo& sensor = sequence->header().sensors.at(0);
    EXPECT_EQ(sensor.model, "azure-kinect");
    EXPECT_EQ(sensor.depth_unit_m, 1e-3);
    EXPECT_FALSE(sensor.color_intrinsics);
    EXPECT_THAT(sequence->header().source, HasSubstr("320 x 288 (NFOV_2X2BINNED), 30 frames"));
    ASSERT_EQ(sequence->frames().size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
      const auto frame = sequence->read(i);
      ASSERT_TRUE(frame) << frame.error().text();
      EXPECT_EQ(frame->depth.pixels, noise_image(320, 288, i).pixels);
      EXPECT_NEAR(frame->info.time_s, double(i) / 30.0, 1.1e-6);
      EXPECT_EQ(frame->info.index, i);
    }
  }
}

TEST(MatroskaImport, CropsAndBinsTheCalibrationAsTheModeDoes) {
  const TempFolder folder;
  struct Mode {
    int width, height;
    double fx, cx, cy;
  };
  // By hand: widths of the sensor, less the crop, less half a pixel.
  for (const Mode& mode :
       {Mode{640, 576, 0.492781 * 1024, 0.51297 * 1024 - 192.5, 0.516924 * 1024 - 180.5},
        Mode{320, 288, 0.492781 * 512, 0.51297 * 512 - 96.5, 0.516924 * 512 - 90.5},
        Mode{512, 512, 0.492781 * 512, 0.51297 * 512 - 0.5, 0.516924 * 512 - 0.5},
        Mode{1024, 1024, 0.492781 * 1024, 0.51297 * 1024 - 0.5, 0.516924 * 1024 - 0.5}}) {
    K4aTake take;
    take.width = mode.width, take.height = mode.height;
    take.add_depth(0.0, DepthImage(mode.width, mode.height, 1000));
    const auto sequence = opened(folder, take);
    ASSERT_TRUE(sequence);
    const CameraIntrinsics& camera = sequence->header().sensors.at(0).intrinsics;
    EXPECT_EQ(camera.width, mode.width);
    EXPECT_NEAR(camera.fx, mode.fx, 1e-9);
    EXPECT_NEAR(camera.cx, mode.cx, 1e-9);
    EXPECT_NEAR(camera.cy, mode.cy, 1e-9);
    EXPECT_EQ(camera.distortion, (std::array<double, 8>{0.54794, -0.020971, 2.056e-5, -7.21e-5,
                                                        -0.0026522, 0.889679, 0.08613, -0.01391}));
    // Beyond 60 degrees the lens is not known: the corners of the wide modes.
    const auto frame = sequence->read(0);
    ASSERT_TRUE(frame);
    const RayTable rays(camera);
    int known = 0, unknown = 0;
    for (std::size_t i = 0; i < frame->depth.pixels.size(); i += 7) {
      const double r = std::hypot(double(rays.x()[i]), double(rays.y()[i]));
      if (frame->depth.pixels[i] == kNoReturn) {
        ++unknown;
        EXPECT_FALSE(r < 1.73);
      } else {
        ++known;
        EXPECT_LT(r, 1.75);
      }
    }
    EXPECT_GT(known, 0);
    EXPECT_EQ(unknown > 0, mode.width == mode.height);
  }
}

ColorImage gradient(int width, int height, int seed) {
  ColorImage image(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      image.at(u, v) = {std::uint8_t(60 + 100 * u / width), std::uint8_t(60 + 100 * v / height),
                        std::uint8_t(40 * seed)};
  return image;
}

double mean_difference(const ColorImage& a, const ColorImage& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    sum += std::abs(a.pixels[i].r - b.pixels[i].r) + std::abs(a.pixels[i].g - b.pixels[i].g) +
           std::abs(a.pixels[i].b - b.pixels[i].b);
  return sum / (3.0 * double(a.pixels.size()));
}

/// BT.601 in floating point, chroma of the first of each pair or four.
std::string packed(const ColorImage& image, const std::string& codec) {
  std::string out;
  const auto byte = [](double value) { return char(std::uint8_t(std::lround(value))); };
  const auto y = [](const Rgb& c) { return 16 + 0.2568 * c.r + 0.5041 * c.g + 0.0979 * c.b; };
  const auto cb = [](const Rgb& c) { return 128 - 0.1482 * c.r - 0.2910 * c.g + 0.4392 * c.b; };
  const auto cr = [](const Rgb& c) { return 128 + 0.4392 * c.r - 0.3678 * c.g - 0.0714 * c.b; };
  if (codec == "BGRA")
    for (const Rgb& c : image.pixels) out += {char(c.b), char(c.g), char(c.r), '\x00'};
  if (codec == "YUY2")
    for (std::size_t i = 0; i < image.pixels.size(); i += 2)
      out += {byte(y(image.pixels[i])), byte(cb(image.pixels[i])), byte(y(image.pixels[i + 1])),
              byte(cr(image.pixels[i]))};
  if (codec == "NV12") {
    for (const Rgb& c : image.pixels) out += byte(y(c));
    for (int v = 0; v < image.height; v += 2)
      for (int u = 0; u < image.width; u += 2)
        out += {byte(cb(image.at(u, v))), byte(cr(image.at(u, v)))};
  }
  return out;
}

TEST(MatroskaImport, TakesTheColourImageNearestInTimeInEveryPacking) {
  const TempFolder folder;
  for (const std::string codec : {"MJPG", "NV12", "YUY2", "BGRA"}) {
    K4aTake take = small_take(2);
    take.color_codec = codec;
    for (int i = 0; i < 3; ++i) {
      const ColorImage image = gradient(1280, 720, i);
      take.color.push_back({std::uint64_t(300000 + 33333 * i),
                            codec == "MJPG" ? *encode_color_jpeg(image) : packed(image, codec)});
    }
    const auto sequence = opened(folder, take);
    ASSERT_TRUE(sequence);
    const SensorInfo& sensor = sequence->header().sensors.at(0);
    ASSERT_TRUE(sensor.color_intrinsics);
    EXPECT_NEAR(sensor.color_intrinsics->fx, 0.477965 * 1280, 1e-9);
    EXPECT_NEAR(sensor.color_intrinsics->cy, 0.506618 * 960 - 120.5, 1e-9);
    EXPECT_NEAR(sensor.T_color_sensor.translation().x(), -0.0320834, 1e-6);
    // 336 ms is nearest to 333 ms, 369 ms to 366 ms.
    for (std::size_t i = 0; i < 2; ++i) {
      const auto frame = sequence->read(i);
      ASSERT_TRUE(frame) << frame.error().text();
      ASSERT_EQ(frame->color.width, 1280);
      EXPECT_LT(mean_difference(frame->color, gradient(1280, 720, int(i) + 1)), 2.0) << codec;
      EXPECT_EQ(frame->color_jpeg, codec == "MJPG" ? take.color[i + 1].bytes : std::string());
    }
  }
}

TEST(MatroskaImport, FramesThatAreMissingByTheirTimesAreDropped) {
  const TempFolder folder;
  K4aTake take;
  for (const int i : {0, 1, 4, 5})
    take.add_depth(i / 30.0, noise_image(320, 288, std::uint64_t(i)));
  const auto sequence = opened(folder, take);
  ASSERT_TRUE(sequence);
  ASSERT_EQ(sequence->frames().size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(sequence->frames()[i].status == FrameStatus::kDropped, i == 2 || i == 3);
    EXPECT_NEAR(sequence->frames()[i].time_s, double(i) / 30.0, 2e-6);
  }
  EXPECT_FALSE(sequence->read(2));
  EXPECT_EQ(sequence->read(4)->depth.pixels, noise_image(320, 288, 4).pixels);
  EXPECT_THAT(sequence->header().source, HasSubstr("2 frames are missing"));
}

TEST(MatroskaImport, TellsAFemtoByItsSerialNumber) {
  const TempFolder folder;
  K4aTake take = small_take(1);
  take.tags = {{"K4A_DEVICE_SERIAL_NUMBER", "CL8F25300J6"}};
  EXPECT_EQ(opened(folder, take)->header().sensors[0].model, "orbbec-femto");
}

TEST(MatroskaImport, WithoutACalibrationItAsksForTheIntrinsics) {
  const TempFolder folder;
  K4aTake take = small_take(1);
  take.calibration.clear();
  const Error error = refused(folder, take);
  EXPECT_EQ(error.code, ErrorCode::kMissingData);
  EXPECT_THAT(error.message, HasSubstr("--intrinsics"));
  ImportOptions options;
  options.intrinsics = "250,251,160,144";
  EXPECT_EQ(opened(folder, take, options)->header().sensors[0].intrinsics.fy, 251.0);
}

TEST(MatroskaImport, WhatItDoesNotReadIsNamed) {
  const TempFolder folder;
  K4aTake take = small_take(1);
  take.depth_codec = "H264";
  EXPECT_THAT(refused(folder, take).message, HasSubstr("H264"));
  take = small_take(1);
  take.calibration = "{\"CalibrationInformation\": {\"Cameras\": []}}";
  EXPECT_THAT(refused(folder, take).message, HasSubstr("does not describe a depth camera"));
  take.calibration = "{";
  EXPECT_EQ(refused(folder, take).code, ErrorCode::kFormat);
  take = small_take(1);
  take.width = 300;
  EXPECT_EQ(refused(folder, take).code, ErrorCode::kUnsupported);
  take = small_take(1);
  take.depth.clear();
  EXPECT_EQ(refused(folder, take).code, ErrorCode::kTooFewPoints);
  take = small_take(2);
  take.depth[1].bytes.resize(1000);
  const auto sequence = opened(folder, take);
  EXPECT_TRUE(sequence->read(0));
  EXPECT_THAT(sequence->read(1).error().message, HasSubstr("frame 1 at byte"));
}

TEST(MatroskaImport, AFileThatIsCutOffOpensAsFarAsItIsWhole) {
  const TempFolder folder;
  small_take(12).write(folder / "take.mkv");
  const std::string whole = bytes_of(folder / "take.mkv");
  std::size_t most = 0;
  for (std::size_t part = 0; part <= 50; ++part) {
    folder.put("cut.mkv", std::string_view(whole).substr(0, whole.size() * part / 50));
    const auto sequence = open_foreign(folder / "cut.mkv", {});
    if (!sequence) {
      EXPECT_LT(part, 6u) << sequence.error().text();
      continue;
    }
    const std::size_t count = (*sequence)->frames().size();
    EXPECT_GE(count, most);
    most = count;
    EXPECT_EQ((*sequence)->header().source.find("cut off") != std::string::npos, part < 50);
    for (std::size_t i = 0; i < count; ++i)
      EXPECT_EQ((*sequence)->read(i)->depth.pixels, noise_image(320, 288, i).pixels);
  }
  EXPECT_EQ(most, 12u);
}

TEST(MatroskaImport, FlippedBitsGiveAnErrorOrFewerFrames) {
  const TempFolder folder;
  K4aTake take = small_take(3);
  take.calibration = testing::k4a_calibration();
  take.write(folder / "take.mkv");
  const std::string whole = bytes_of(folder / "take.mkv");
  for (std::uint64_t i = 0; i < 400; ++i) {
    std::string damaged = whole;
    // Half of them in the headers.
    const std::size_t at = mix64(i) % (i % 2 == 0 ? 3000 : damaged.size());
    damaged[at] = char(damaged[at] ^ (1 << mix64(i + 7) % 8));
    folder.put("bad.mkv", damaged);
    const auto sequence = open_foreign(folder / "bad.mkv", {});
    if (!sequence) {
      EXPECT_EQ(sequence.error().message.find('\n'), std::string::npos);
      continue;
    }
    EXPECT_LE((*sequence)->frames().size(), 3u + 1003u);
    for (std::size_t k = 0; k < std::min<std::size_t>((*sequence)->frames().size(), 3); ++k)
      (void)(*sequence)->read(k);
  }
}

}  // namespace
}  // namespace turnscan
