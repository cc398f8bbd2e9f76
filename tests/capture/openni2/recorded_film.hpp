#pragma once
// Films of the tests' OpenNI driver, and files that OpenNI's recorder makes of them.

#include <OpenNI.h>
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <turnscan/capture/source/frame_source.hpp>
#include <turnscan/capture/source/source_uri.hpp>
#include <utility>
#include <vector>

#include "tests/capture/openni2/film.hpp"

namespace turnscan::testing {

inline std::string uri_of(const std::string& address,
                          const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  return format_source_uri({"openni2", address, parameters});
}

inline std::string film_uri(
    const std::filesystem::path& file,
    const std::vector<std::pair<std::string, std::string>>& parameters = {}) {
  return uri_of("test:film:" + file.string(), parameters);
}

/// Of the driver of the tests, once OpenNI has loaded it.
inline void allow_frames(int count) {
  void* const driver = dlopen(TURNSCAN_OPENNI2_DRIVER, RTLD_NOW | RTLD_NOLOAD);
  ASSERT_NE(driver, nullptr) << dlerror();
  const auto allow = reinterpret_cast<AllowFrames>(dlsym(driver, kAllowFrames));
  dlclose(driver);
  ASSERT_NE(allow, nullptr);
  allow(count);
}

/// Plays the film and has OpenNI record it. The recorder begins at some time of its own after it
/// was told to, so that it may miss frames: then it is given more time.
inline void record_oni(const std::filesystem::path& film, int count,
                       const std::filesystem::path& oni) {
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

}  // namespace turnscan::testing
