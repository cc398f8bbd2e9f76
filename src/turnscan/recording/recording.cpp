#include <algorithm>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/recording/file_check.hpp>
#include <turnscan/recording/frames_csv.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/recording_json.hpp>

namespace turnscan::recording_format {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Error> in_file(const fs::path& path, Error error) {
  if (error.path.empty()) error.path = path.string();
  return tl::unexpected<Error>(std::move(error));
}

Result<RecordingDescription> read_description(const fs::path& folder) {
  const fs::path path = folder / "recording.json";
  auto text = read_file(path, kMaxDescriptionBytes);
  if (!text && text.error().code == ErrorCode::kNotFound)
    return fail_at(folder.string(), ErrorCode::kNotFound,
                   "there is no recording here (no recording.json); name the folder of one, or "
                   "import what is there ('turnscan import --list' shows the layouts)");
  if (!text) return tl::unexpected<Error>(std::move(text).error());
  auto description = parse_recording_json(*text);
  if (!description) return in_file(path, std::move(description).error());
  return description;
}

/// A writer that was killed between the two files leaves no table: a recording without frames.
Result<FrameTable> read_table(const fs::path& folder, std::size_t sensor_count,
                              const RunContext& context) {
  const fs::path path = folder / "frames.csv";
  auto text = read_file(path, kMaxTableBytes);
  if (!text && text.error().code == ErrorCode::kNotFound)
    return FrameTable{{}, {"frames.csv is missing: there are no frames"}};
  if (!text) return tl::unexpected<Error>(std::move(text).error());
  if (text->find('\n') == std::string::npos)
    return FrameTable{{}, {"frames.csv has no whole line: there are no frames"}};
  auto table = parse_frames_csv(*text, sensor_count, context);
  if (!table) return in_file(path, std::move(table).error());
  return table;
}

/// Collects defects of one kind, so that a thousand lost frames are one note.
class DefectNote {
 public:
  explicit DefectNote(std::string consequence) : consequence_(std::move(consequence)) {}
  void add(const FrameInfo& frame, const std::string& file, const std::string& defect) {
    if (count_++ == 0)
      first_ =
          fmt::format("frame {}: {} {}", frame.index, file.empty() ? "its file" : file, defect);
  }
  void put_into(std::vector<std::string>& notes) const {
    if (count_ == 1) notes.push_back(fmt::format("{}; {}", first_, consequence_));
    if (count_ > 1)
      notes.push_back(fmt::format("{}, and {} more like it; {}", first_, count_ - 1, consequence_));
  }

 private:
  std::string consequence_;
  std::string first_;
  std::size_t count_ = 0;
};

/// If this program lacks resources for the check, that is no defect of the frame.
tl::unexpected<Error> no_resources(const FileCheck& check, const fs::path& file) {
  return fail_at(file.string(), ErrorCode::kResourceLimit,
                 "it {}; raise the limit (ulimit -n) or end other programs", check.words);
}

Result<> check_files(const fs::path& folder, std::vector<FrameRow>& rows,
                     std::vector<std::string>& notes, const RunContext& context) {
  DefectNote dropped("marked dropped"), unread("left out"), colorless("read without colour");
  for (FrameRow& row : rows) {
    TURNSCAN_TRY(context.check());
    if (row.info.status == FrameStatus::kDropped) continue;
    const FileCheck check = check_frame_file(folder, row);
    if (check.state == FileState::kNoResources) return no_resources(check, folder / row.info.file);
    if (check.state != FileState::kWhole) {
      (check.state == FileState::kLost ? dropped : unread)
          .add(row.info, row.info.file, check.words);
      row.info.status = FrameStatus::kDropped;
      continue;
    }
    if (row.color_file.empty()) continue;
    const FileCheck color = check_file(folder / row.color_file);
    if (color.state == FileState::kNoResources) return no_resources(color, folder / row.color_file);
    if (color.state == FileState::kWhole) continue;
    colorless.add(row.info, row.color_file, color.words);
    row.color_file.clear();
  }
  dropped.put_into(notes);
  unread.put_into(notes);
  colorless.put_into(notes);
  return {};
}

/// The length of a PLY with lists cannot be checked cheaply: the last one is read.
void check_last_scan(const fs::path& folder, const SequenceHeader& header,
                     std::vector<FrameRow>& rows, std::vector<std::string>& notes) {
  const auto last = std::find_if(rows.rbegin(), rows.rend(), [](const FrameRow& row) {
    return row.info.status == FrameStatus::kOk;
  });
  if (last == rows.rend() || header.sensors[last->info.sensor].kind != SensorKind::kPointScanner)
    return;
  if (const auto cloud = read_cloud(folder / last->info.file); !cloud) {
    last->info.status = FrameStatus::kDropped;
    notes.push_back(fmt::format("frame {}: {} is damaged ({}); marked dropped", last->info.index,
                                last->info.file, cloud.error().message));
  }
}

void note_completeness(const RecordingDescription& description, std::size_t frames,
                       std::vector<std::string>& notes) {
  if (!description.complete)
    notes.emplace_back(
        "the recording was not finished: it holds the frames that were written until then");
  if (description.complete && description.frame_count && *description.frame_count != frames)
    notes.push_back(fmt::format("frames.csv lists {} frames, but {} were recorded", frames,
                                *description.frame_count));
}

Result<> check_size(const Frame& frame, const SensorInfo& sensor) {
  const CameraIntrinsics& camera = sensor.intrinsics;
  if (frame.depth.width == camera.width && frame.depth.height == camera.height) return {};
  return fail(ErrorCode::kFormat, "the depth image has {} x {} pixels, but its sensor has {} x {}",
              frame.depth.width, frame.depth.height, camera.width, camera.height);
}

Result<> check_color_size(const Frame& frame, const SensorInfo& sensor) {
  const bool depth = sensor.kind == SensorKind::kDepthCamera;
  if (!sensor.color_intrinsics && !depth) return {};
  const CameraIntrinsics& camera =
      sensor.color_intrinsics ? *sensor.color_intrinsics : sensor.intrinsics;
  if (frame.color.width == camera.width && frame.color.height == camera.height) return {};
  return fail(ErrorCode::kFormat, "the colour image has {} x {} pixels, but its camera has {} x {}",
              frame.color.width, frame.color.height, camera.width, camera.height);
}

Result<> read_points(const fs::path& path, Frame& frame) {
  TURNSCAN_ASSIGN(CloudFile file, read_cloud(path));
  frame.points = std::move(file.cloud);
  frame.grid_width = file.grid_width;
  frame.grid_height = file.grid_height;
  frame.grid = std::move(file.grid);
  return {};
}

}  // namespace

}  // namespace turnscan::recording_format

namespace turnscan {

using namespace recording_format;
namespace fs = std::filesystem;

Result<Recording> Recording::open(const fs::path& folder, const RunContext& context) {
  Recording recording;
  recording.folder_ = folder;
  TURNSCAN_ASSIGN(RecordingDescription description, read_description(folder));
  TURNSCAN_ASSIGN(FrameTable table, read_table(folder, description.header.sensors.size(), context));
  recording.notes_ = std::move(table.notes);
  note_completeness(description, table.rows.size(), recording.notes_);
  TURNSCAN_TRY(check_files(folder, table.rows, recording.notes_, context));
  check_last_scan(folder, description.header, table.rows, recording.notes_);
  recording.header_ = std::move(description.header);
  recording.capture_ = std::move(description.capture);
  recording.complete_ = description.complete;
  recording.frames_.reserve(table.rows.size());
  recording.color_files_.reserve(table.rows.size());
  for (FrameRow& row : table.rows) {
    const auto& resumed = description.resumed_at;
    row.info.stretch = static_cast<std::uint32_t>(
        std::upper_bound(resumed.begin(), resumed.end(), row.info.index) - resumed.begin());
    recording.frames_.push_back(std::move(row.info));
    recording.color_files_.push_back(std::move(row.color_file));
  }
  return recording;
}

Result<Frame> Recording::read(std::size_t position) const {
  if (position >= frames_.size())
    throw std::invalid_argument(fmt::format("recording: there is no frame {}", position));
  Frame frame;
  frame.info = frames_[position];
  const SensorInfo& sensor = header_.sensors[frame.info.sensor];
  const fs::path path = folder_ / frame.info.file;
  if (frame.info.status == FrameStatus::kDropped)
    return fail_at(folder_.string(), ErrorCode::kMissingData, "frame {} was dropped",
                   frame.info.index);
  if (sensor.kind == SensorKind::kPointScanner) {
    TURNSCAN_TRY(read_points(path, frame));
  } else {
    TURNSCAN_ASSIGN(frame.depth, read_depth_png(path));
    if (auto good = check_size(frame, sensor); !good) return in_file(path, std::move(good).error());
  }
  if (color_files_[position].empty()) return frame;
  const fs::path color_path = folder_ / color_files_[position];
  TURNSCAN_TRY(read_frame_color(color_path, frame));
  if (auto good = check_color_size(frame, sensor); !good)
    return in_file(color_path, std::move(good).error());
  return frame;
}

}  // namespace turnscan
