#pragma once
// What the programs that turnscan is compared with share: reading a recording as their users would,
// the crop, times of the stages, figures. Everything on one thread but what their libraries do.

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <turnscan/core/option_table.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan::plain {

struct CropAndFilter {
  double crop_margin_m = 0.005;
  double crop_radius_m = 0.0;
  int outlier_k = 10;
  double outlier_lambda = 1.0;
};
inline OptionTable describe(CropAndFilter& o) {
  OptionTable table;
  table.number("crop-margin", o.crop_margin_m, Quantity::kLength, {-0.1, 1.0}, "as turnscan's")
      .number("crop-radius", o.crop_radius_m, Quantity::kLength, {0.0, 100.0}, "0: no crop")
      .number("outlier-k", o.outlier_k, {1, 1000}, "as turnscan's")
      .number("outlier-lambda", o.outlier_lambda, Quantity::kNone, {0.0, 100.0}, "as turnscan's");
  return table;
}

/// Seconds per stage, in order; the time between two calls of lap() goes to the stage named.
class Stopwatch {
 public:
  void lap(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    for (auto& [name, sum] : stages_)
      if (name == stage) {
        sum += seconds;
        return;
      }
    stages_.emplace_back(stage, seconds);
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

struct Figures {
  std::size_t frames = 0, returns = 0, points = 0, candidates = 0, vertices = 0, triangles = 0;
};

struct Tally {
  Stopwatch watch;
  Figures figures;
};

/// A recording with the place of each frame.
class Scan {
 public:
  static Result<Scan> open(const std::string& folder) {
    TURNSCAN_ASSIGN(Recording recording, Recording::open(folder));
    TURNSCAN_ASSIGN(FramePoses poses,
                    frame_poses(recording.header(), recording.frames(), std::nullopt));
    Scan scan(std::move(recording), std::move(poses));
    for (const SensorInfo& sensor : scan.recording_.header().sensors)
      scan.rays_.push_back(sensor.kind == SensorKind::kDepthCamera ? RayTable(sensor.intrinsics)
                                                                   : RayTable());
    return scan;
  }
  const std::vector<FrameInfo>& frames() const { return recording_.frames(); }
  bool usable(std::size_t i) const { return frames()[i].status == FrameStatus::kOk; }
  const Pose& pose(std::size_t i) const { return poses_.T_table_sensor[i]; }
  const SensorInfo& sensor(std::size_t i) const {
    return recording_.header().sensors.at(frames()[i].sensor);
  }
  /// All returns of a frame, sensor frame.
  Result<FramePoints> points(std::size_t i, Tally& tally) const {
    TURNSCAN_ASSIGN(const Frame frame, recording_.read(i));
    TURNSCAN_ASSIGN(FramePoints points, points_of(frame, sensor(i), rays_[frame.info.sensor]));
    ++tally.figures.frames;
    tally.figures.returns += points.cloud.size();
    tally.watch.lap("read");
    return points;
  }
  FramePoints cropped(const FramePoints& points, std::size_t i, const CropAndFilter& options,
                      Tally& tally) const {
    if (options.crop_radius_m == 0.0) return points;
    Cylinder cylinder;
    cylinder.margin_m = options.crop_margin_m;
    cylinder.radius_m = options.crop_radius_m;
    FramePoints out = crop(points, SensorCrop(cylinder, pose(i)));
    tally.watch.lap("crop");
    return out;
  }

 private:
  Scan(Recording recording, FramePoses poses)
      : recording_(std::move(recording)), poses_(std::move(poses)) {}
  Recording recording_;
  FramePoses poses_;
  std::vector<RayTable> rays_;
};

inline Result<> read_options(const OptionTable& table, const std::vector<std::string>& arguments) {
  for (std::size_t i = 0; i + 1 < arguments.size(); i += 2) {
    const std::string& name = arguments[i];
    TURNSCAN_TRY(table.set(name.starts_with("--") ? name.substr(2) : name, arguments[i + 1]));
  }
  return table.check();
}

inline std::string figures_json(const Tally& tally) {
  std::string seconds;
  double total = 0.0;
  for (const auto& [stage, value] : tally.watch.stages()) {
    seconds += fmt::format("{}\"{}\": {:.4f}", seconds.empty() ? "" : ", ", stage, value);
    total += value;
  }
  struct rusage usage {};
  getrusage(RUSAGE_SELF, &usage);
  const Figures& f = tally.figures;
  return fmt::format(
      "{{\"frames\": {}, \"returns\": {}, \"points\": {}, \"candidates\": {}, \"vertices\": {}, "
      "\"triangles\": {},\n \"seconds\": {{{}}}, \"seconds_total\": {:.4f}, "
      "\"peak_memory_mb\": {:.1f}}}\n",
      f.frames, f.returns, f.points, f.candidates, f.vertices, f.triangles, seconds, total,
      double(usage.ru_maxrss) / 1024.0);
}

/// Writes the mesh and, where json names a file, the figures.
inline Result<> finish(const TriangleMesh& mesh, const std::string& output, const std::string& json,
                       Tally& tally) {
  tally.figures.vertices = mesh.vertices.size();
  tally.figures.triangles = mesh.triangles.size();
  TURNSCAN_TRY(write_mesh(output, mesh));
  tally.watch.lap("write");
  const std::string text = figures_json(tally);
  std::fputs(text.c_str(), stdout);
  return json.empty() ? Result<>() : write_file_atomically(json, text);
}

/// Exit status of a program.
inline int report(const char* program, const Result<>& result) {
  if (result) return 0;
  fmt::print(stderr, "{}: {}\n", program, result.error().text());
  return result.error().code == ErrorCode::kInvalidOption ? 2 : 1;
}

}  // namespace turnscan::plain
