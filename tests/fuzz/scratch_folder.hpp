#pragma once
// A folder in which a fuzz target lays out its input as files, and what every sequence promises.

#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/import/importers.hpp>
#include <vector>

#include "tests/fuzz/checks.hpp"

namespace turnscan::fuzz {

/// One for the whole run of a target; removed at its end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "turnscan-fuzz-XXXXXX").string();
    require(::mkdtemp(name.data()) != nullptr, "a scratch folder");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  void put(std::string_view name, std::string_view content) const {
    std::ofstream(path_ / name, std::ios::binary | std::ios::trunc) << content;
  }
  void put_scan(std::string_view name) const {
    PointCloud cloud;
    cloud.points = {Vec3f(0.1f, 0.2f, 0.3f), Vec3f(0.2f, 0.2f, 0.3f)};
    require(bool(write_cloud(path_ / name, cloud)), "a scan");
  }
  void put_depth(std::string_view name) const {
    require(bool(write_depth_png(path_ / name, DepthImage(4, 3, 1000))), "a depth image");
  }

 private:
  std::filesystem::path path_;
};

inline bool finite(const Pose& pose) { return pose.matrix().allFinite(); }

inline void check(const FrameSequence& sequence) {
  const SequenceHeader& header = sequence.header();
  require(!header.sensors.empty(), "a sensor");
  for (const SensorInfo& sensor : header.sensors) {
    require(sensor.kind == SensorKind::kPointScanner || bool(sensor.intrinsics.check()), "camera");
    require(sensor.viewpoint.value.allFinite(), "viewpoint");
    require(std::isfinite(sensor.depth_unit_m) && sensor.depth_unit_m > 0.0, "depth unit");
  }
  if (header.turntable)
    require(header.turntable->center_m.allFinite() &&
                std::abs(header.turntable->axis.norm() - 1.0) < 1e-9,
            "turntable");
  const std::vector<FrameInfo>& frames = sequence.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameInfo& info = frames[i];
    require(i == 0 || frames[i - 1].index < info.index, "order of the indices");
    require(info.sensor < header.sensors.size(), "sensor");
    require(!std::isinf(info.time_s), "time");
    require(!info.angle_rad || std::isfinite(*info.angle_rad), "angle");
    require(!info.T_table_sensor || finite(*info.T_table_sensor), "pose");
  }
  if (!frames.empty()) (void)sequence.read(0);
}

/// Opens path as that layout with all that it may ask for.
inline void check_import(const std::filesystem::path& path, const ImportOptions& options) {
  const auto sequence = open_foreign(path, options);
  if (sequence) check(**sequence);
}

/// The input up to the first zero byte, and what follows it.
inline std::pair<std::string_view, std::string_view> split(std::string_view text) {
  const std::size_t zero = text.find('\0');
  if (zero == std::string_view::npos) return {text, {}};
  return {text.substr(0, zero), text.substr(zero + 1)};
}

}  // namespace turnscan::fuzz
