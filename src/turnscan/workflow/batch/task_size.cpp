#include <turnscan/workflow/batch/task_size.hpp>

#include <algorithm>
#include <turnscan/core/units.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/simulator/scene_file.hpp>
#include <turnscan/workflow/input.hpp>

namespace turnscan::batch {

namespace {

// Measured with Kinect v2, D435 and Azure Kinect, 40 to 400 frames, all methods: 80 to 222 MB; this
// estimate is 1.3 to 2.2 times as much (docs/research/scale.md).
constexpr double kProgramBytes = 72e6;
constexpr double kBytesPerPixel = 1.5;     // of all frames, kept by a method
constexpr double kBytesPerDecoded = 40.0;  // of one frame, while it is decoded
// Divided by the square of the voxel size, for a surface twice that of a figure of 20 cm.
constexpr double kSquareMetreBytes = 80.0;
constexpr double kUsualVoxel_m = 1.3e-3;  // if it is chosen from the data

constexpr double kSimulateBytes = 250e6;

std::optional<std::string> option_of(const BatchTask& task, const std::string& name) {
  for (const auto& [key, value] : task.options)
    if (key == name) return value;
  return std::nullopt;
}

void measure_simulation(BatchTask& task) {
  SceneDescription scene;
  task.peak_bytes = static_cast<std::uint64_t>(kSimulateBytes);
  for (SceneTable& table : describe(scene)) {
    const OptionField* frames = table.options.find("frames");
    if (frames == nullptr) continue;
    if (const auto given = option_of(task, "frames")) (void)frames->set(*given);
    const auto count = parse_quantity(frames->get(), Quantity::kNone);
    task.frames = count ? static_cast<std::uint64_t>(std::max(*count, 0.0)) : 0;
  }
}

double voxel_of(const BatchTask& task) {
  const auto text = option_of(task, "voxel-size");
  const double size =
      text ? parse_quantity(*text, Quantity::kLength).value_or(kUsualVoxel_m) : kUsualVoxel_m;
  return size > 0.0 ? size : kUsualVoxel_m;
}

}  // namespace

void measure_task(BatchTask& task) {
  if (task.command == "simulate") {
    measure_simulation(task);
    return;
  }
  double pixels = 0.0, largest = 0.0;
  std::vector<std::string> imports;
  for (const auto& [name, value] : task.options)
    if (name == "import") imports.push_back(value);
  for (const std::string& path : task.inputs) {
    const auto input = open_input_asking(path, imports);
    if (!input) continue;
    const FrameSequence& recording = *input->frames;
    task.frames += recording.frames().size();
    for (const SensorInfo& sensor : recording.header().sensors)
      largest = std::max(largest, double(sensor.intrinsics.width) * sensor.intrinsics.height);
    pixels += largest * static_cast<double>(recording.frames().size());
  }
  const double voxel = voxel_of(task);
  task.peak_bytes =
      static_cast<std::uint64_t>(kProgramBytes + kBytesPerPixel * pixels +
                                 kBytesPerDecoded * largest + kSquareMetreBytes / (voxel * voxel));
}

}  // namespace turnscan::batch
