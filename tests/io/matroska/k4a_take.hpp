#pragma once
// Recordings of an Azure Kinect for tests, written by libmatroska: the library with which
// Microsoft's recorder writes them.

#include <cstdint>
#include <filesystem>
#include <string>
#include <turnscan/core/image.hpp>
#include <utility>
#include <vector>

namespace turnscan::testing {

/// A factory calibration (the one in pyk4a's test recording, rounded): NFOV and WFOV, 4:3 colour.
std::string k4a_calibration(double metric_radius = 1.74);

struct K4aTake {
  struct Image {
    std::uint64_t time_us = 0;
    std::string bytes;
  };
  int width = 320, height = 288;
  std::vector<Image> depth;
  std::string depth_codec = "b16g";
  int color_width = 1280, color_height = 720;
  std::string color_codec = "MJPG";
  std::vector<Image> color;  ///< empty: no track
  std::uint64_t frame_time_ns = 33333333;
  std::string calibration = k4a_calibration();  ///< empty: no attachment
  std::vector<std::pair<std::string, std::string>> tags = {
      {"K4A_DEVICE_SERIAL_NUMBER", "001514394512"}, {"K4A_START_OFFSET_NS", "336277000"}};
  bool cues = true;
  bool block_groups = false;  ///< else simple blocks

  void add_depth(double time_s, const DepthImage& image);
  void write(const std::filesystem::path& path) const;
};

/// 16 bits a pixel, the high byte first.
std::string big_endian(const DepthImage& image);

}  // namespace turnscan::testing
