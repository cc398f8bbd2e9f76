#pragma once
// A dump as libfreenect's fakenect plays it back, from frames of a virtual sensor: a Kinect v1 that
// sees what the simulator computes.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <turnscan/core/image.hpp>
#include <vector>

#include "plugins/freenect/kinect_v1.hpp"

namespace turnscan::testing {

/// For each depth in steps of 0.1 mm the raw value whose depth is nearest.
inline std::vector<std::uint16_t> raw_values() {
  const std::vector<std::uint16_t> table = plugin::KinectV1().table();
  std::vector<std::uint16_t> raw(65536, plugin::KinectV1::kNoValue);
  std::uint16_t best = 0;
  for (std::uint32_t depth = 1; depth < 65536; ++depth) {
    const auto far = [&](std::uint16_t r) { return std::abs(int(table[r]) - int(depth)); };
    while (best + 1 < plugin::KinectV1::kNoValue && table[best + 1u] != 0 &&
           (table[best] == 0 || far(static_cast<std::uint16_t>(best + 1)) <= far(best)))
      ++best;
    if (table[best] != 0) raw[depth] = best;
  }
  return raw;
}

/// The same image as the sensor would measure it, in raw values.
inline DepthImage to_raw(const DepthImage& depth) {
  static const std::vector<std::uint16_t> values = raw_values();
  DepthImage raw = depth;
  for (std::uint16_t& value : raw.pixels) value = values[value];
  return raw;
}

/// And what it then delivers, in steps of 0.1 mm.
inline DepthImage rounded_as_kinect(const DepthImage& depth) {
  static const std::vector<std::uint16_t> table = plugin::KinectV1().table();
  DepthImage out = to_raw(depth);
  for (std::uint16_t& value : out.pixels) value = table[value];
  return out;
}

/// Adds frames to a folder: the images, and INDEX.txt that lists them.
class DumpWriter {
 public:
  explicit DumpWriter(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
  }

  /// Played back `pause_s` after the one before it; the sensor's clock counts `ticks`.
  void add(const DepthImage& depth, std::uint32_t ticks, double pause_s = 0.0005) {
    time_s_ += pause_s;
    const std::string name = "d-" + std::to_string(time_s_) + "-" + std::to_string(ticks) + ".pgm";
    std::ofstream file(folder_ / name, std::ios::binary);
    file << "P5 " << depth.width << ' ' << depth.height << " 65535\n";
    const DepthImage raw = to_raw(depth);
    file.write(reinterpret_cast<const char*>(raw.pixels.data()),
               static_cast<std::streamsize>(raw.pixels.size() * sizeof(std::uint16_t)));
    index_ << name << '\n';
    std::ofstream(folder_ / "INDEX.txt") << index_.str();
  }

 private:
  std::filesystem::path folder_;
  std::ostringstream index_;
  double time_s_ = 1000.0;
};

/// A scanner file of the simulator with the camera of a Kinect v1.
inline std::filesystem::path kinect_v1_file(const std::filesystem::path& folder) {
  const double f = plugin::KinectV1().focal_pixels();
  std::filesystem::path file = folder / "kinect-v1-raw.toml";
  std::ofstream(file) << fmt::format(
      "columns = 640\nrows = 480\nfx = {0}\nfy = {0}\ncx = 320\ncy = 240\nnear = \"0.5m\"\n"
      "far = \"4m\"\n",
      f);
  return file;
}

}  // namespace turnscan::testing
