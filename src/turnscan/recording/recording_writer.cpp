#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <mutex>
#include <system_error>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/version.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/recording/frames_csv.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/recording_json.hpp>
#include <unordered_set>

namespace turnscan::recording_format {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kBatch = 64;  ///< frames whose lines are appended together

tl::unexpected<Error> system_error(const fs::path& path, std::string_view what, int error) {
  return fail_at(path.string(), ErrorCode::kIo, "{}: {}", what,
                 std::generic_category().message(error));
}

constexpr const char* kDescriptionPart = ".recording.json.part";

/// Renames without replacing. Returns errno, or 0.
int rename_to_new(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return 0;
  if (errno != EINVAL && errno != ENOSYS) return errno;
  // For file systems that do not support this.
  if (::access(to.c_str(), F_OK) == 0) return EEXIST;
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

/// frames.csv while it grows: only complete lines, even if the disk is full.
class LineFile {
 public:
  LineFile() = default;
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  bool created() const { return descriptor_ >= 0; }

  Result<> create(const fs::path& path) {
    path_ = path;
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0) return system_error(path_, "cannot create", errno);
    // Without file locks, only the protection against a concurrent repair is lost.
    (void)::flock(descriptor_, LOCK_EX | LOCK_NB);
    return {};
  }

  /// Reopens the file of a complete recording, to append after its last line.
  Result<> reopen(const fs::path& path, std::uint64_t size) {
    path_ = path;
    size_ = size;
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0) return system_error(path_, "cannot append a line", errno);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      return fail_at(path.parent_path().string(), ErrorCode::kIo,
                     "another program writes it just now; wait until that has ended");
    return {};
  }

  /// A single write(): either all lines are written, or the file is truncated to its last complete
  /// line.
  Result<> append(std::string_view lines) {
    std::size_t done = 0;
    while (done < lines.size()) {
      const ssize_t n = ::write(descriptor_, lines.data() + done, lines.size() - done);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) {
        const int error = errno;
        (void)!::ftruncate(descriptor_, static_cast<off_t>(size_));
        return system_error(path_, "cannot append a line", error);
      }
      done += static_cast<std::size_t>(n);
    }
    size_ += lines.size();
    return {};
  }

  /// kSynced: everything that was written to this file system, in particular the frames' files.
  Result<> sync(Durability durability) {
    if (::fsync(descriptor_) != 0) return system_error(path_, "cannot write", errno);
    if (durability == Durability::kSynced && ::syncfs(descriptor_) != 0)
      return system_error(path_, "cannot write", errno);
    return {};
  }

 private:
  fs::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Creates the folder with its parents; the new ones are added to `made`.
Result<> make_folders(const fs::path& folder, std::vector<fs::path>& made) {
  std::error_code error;
  if (fs::exists(folder, error)) {
    if (!fs::is_directory(folder, error))
      return fail_at(folder.string(), ErrorCode::kAlreadyExists,
                     "there is a file of that name; choose another folder");
    if (!fs::is_empty(folder, error))
      return fail_at(folder.string(), ErrorCode::kAlreadyExists,
                     "the folder is not empty, and a recording is never overwritten; choose "
                     "another one or remove it");
    return {};
  }
  std::vector<fs::path> missing;
  for (fs::path p = folder; !p.empty() && !fs::exists(p, error); p = p.parent_path())
    missing.push_back(p);
  std::reverse(missing.begin(), missing.end());
  for (const fs::path& p : missing) {
    if (fs::create_directory(p, error)) made.push_back(p);
    if (error) return system_error(p, "cannot create the folder", error.value());
  }
  return {};
}

tl::unexpected<Error> misfit(const Frame& frame, const std::string& why) {
  return fail(ErrorCode::kInvalidOption, "recording: frame {} cannot be written: {}",
              frame.info.index, why);
}

Result<> check_pixels(const Frame& frame, const SensorInfo& sensor) {
  const CameraIntrinsics& camera = sensor.intrinsics;
  const DepthImage& depth = frame.depth;
  if (depth.width == camera.width && depth.height == camera.height &&
      depth.pixels.size() == std::size_t(depth.width) * std::size_t(depth.height))
    return {};
  return misfit(frame, fmt::format("its depth image has {} x {} pixels, its sensor {} x {}",
                                   depth.width, depth.height, camera.width, camera.height));
}

Result<> check_frame(const Frame& frame, const SequenceHeader& header) {
  const FrameInfo& info = frame.info;
  if (info.sensor >= header.sensors.size())
    return misfit(frame, fmt::format("there is no sensor {}", info.sensor));
  if (const std::string why = implausible(info); !why.empty()) return misfit(frame, why);
  if (info.status == FrameStatus::kDropped) return {};
  const SensorInfo& sensor = header.sensors[info.sensor];
  // A scan without returns is a frame, too: a profile beside the object.
  return sensor.kind == SensorKind::kDepthCamera ? check_pixels(frame, sensor) : Result<>();
}

}  // namespace

}  // namespace turnscan::recording_format

namespace turnscan {

using namespace recording_format;
namespace fs = std::filesystem;

struct RecordingWriter::State {
  fs::path folder;
  RecordingDescription description;
  ColorFileFormat color = ColorFileFormat::kPng;
  LineFile table;
  std::unordered_set<std::uint32_t> indices;
  std::vector<fs::path> made_folders;  ///< parents first
  bool described = false;              ///< recording.json was written by this writer
  bool finished = false;

  Result<> create_files();
  Result<> reopen_files(std::optional<std::uint32_t> resumed_at, bool was_finished);
  /// Writes the frame's files and returns its line. May run on several threads at once.
  Result<std::string> write_files(const Frame& frame) const;
  Result<std::string> write_color(const Frame& frame, const std::string& number) const;
  Result<> write_data(const Frame& frame, const fs::path& path) const;
  Result<> make_subfolder(const char* name) const;
  Result<> claim_index(const FrameInfo& info);
  /// Removes everything that this writer created.
  void discard();
};

Result<> RecordingWriter::State::make_subfolder(const char* name) const {
  std::error_code error;
  fs::create_directory(folder / name, error);
  if (error) return system_error(folder / name, "cannot create the folder", error.value());
  return {};
}

Result<> RecordingWriter::State::write_data(const Frame& frame, const fs::path& path) const {
  if (!frame.depth.empty()) return write_depth_png(path, frame.depth, Durability::kNamed);
  return write_cloud(
      path, CloudFile{frame.points, frame.grid_width, frame.grid_height, frame.grid, std::nullopt});
}

Result<std::string> RecordingWriter::State::write_color(const Frame& frame,
                                                        const std::string& number) const {
  if (frame.color.empty()) return std::string();
  TURNSCAN_TRY(make_subfolder("color"));
  const bool packed = !frame.color_jpeg.empty();
  const bool png = !packed && color == ColorFileFormat::kPng;
  const std::string name = "color/" + number + (png ? ".png" : ".jpg");
  if (packed) {
    TURNSCAN_TRY(write_file_atomically(folder / name, frame.color_jpeg, Durability::kNamed));
    return name;
  }
  TURNSCAN_TRY(png ? write_color_png(folder / name, frame.color, Durability::kNamed)
                   : write_color_jpeg(folder / name, frame.color, 92, Durability::kNamed));
  return name;
}

Result<std::string> RecordingWriter::State::write_files(const Frame& frame) const {
  TURNSCAN_TRY(check_frame(frame, description.header));
  FrameInfo info = frame.info;
  info.file.clear();
  if (info.status == FrameStatus::kDropped) return frames_csv_line(info, "");
  const std::string number = fmt::format("{:06}", info.index);
  const bool depth = description.header.sensors[info.sensor].kind == SensorKind::kDepthCamera;
  TURNSCAN_TRY(make_subfolder(depth ? "depth" : "points"));
  info.file = depth ? "depth/" + number + ".png" : "points/" + number + ".ply";
  TURNSCAN_TRY(write_data(frame, folder / info.file));
  TURNSCAN_ASSIGN(const std::string color_file, write_color(frame, number));
  return frames_csv_line(info, color_file);
}

Result<> RecordingWriter::State::claim_index(const FrameInfo& info) {
  if (!indices.insert(info.index).second)
    return fail(ErrorCode::kInvalidOption, "recording: there are two frames with the index {}",
                info.index);
  return {};
}

/// recording.json first: a folder without it is not a recording, one without frames.csv is an empty
/// one. It is created without replacing anything, so that of two writers one is rejected.
Result<> RecordingWriter::State::create_files() {
  const fs::path path = folder / "recording.json", part = folder / kDescriptionPart;
  const auto written = write_file_atomically(part, recording_json(description));
  if (!written) return written;
  const int error = rename_to_new(part, path);
  if (error != 0) ::unlink(part.c_str());
  if (error == EEXIST)
    return fail_at(folder.string(), ErrorCode::kAlreadyExists,
                   "another program has just begun a recording here; choose another folder");
  if (error != 0) return system_error(path, "cannot create", error);
  described = true;
  TURNSCAN_TRY(table.create(folder / "frames.csv"));
  return table.append(frames_csv_header());
}

/// The recording is marked incomplete with the number of frames that were complete before, which
/// distinguishes it from one that never was complete.
Result<> RecordingWriter::State::reopen_files(std::optional<std::uint32_t> resumed_at,
                                              bool was_finished) {
  const fs::path json = folder / "recording.json", csv = folder / "frames.csv";
  TURNSCAN_ASSIGN(const std::string text, read_file(json, kMaxDescriptionBytes));
  TURNSCAN_ASSIGN(description, parse_recording_json(text));
  if (!description.complete)
    return fail_at(folder.string(), ErrorCode::kInvalidOption,
                   "it was not finished, so that nothing can be added; finish it with 'turnscan "
                   "info --repair'");
  TURNSCAN_ASSIGN(const std::string lines, read_file(csv, kMaxTableBytes));
  if (!lines.starts_with(frames_csv_header()) || lines.back() != '\n')
    return fail_at(csv.string(), ErrorCode::kUnsupported,
                   "another program wrote it, and nothing can be added to its columns; make a "
                   "recording of its own");
  TURNSCAN_ASSIGN(const FrameTable frames,
                  parse_frames_csv(lines, description.header.sensors.size()));
  for (const FrameRow& row : frames.rows) indices.insert(row.info.index);
  TURNSCAN_TRY(table.reopen(csv, lines.size()));
  description.complete = false;
  description.frame_count.reset();
  if (was_finished) description.frame_count = static_cast<std::uint32_t>(indices.size());
  if (resumed_at) description.resumed_at.push_back(*resumed_at);
  return write_file_atomically(json, recording_json(description));
}

void RecordingWriter::State::discard() {
  std::error_code ignored;
  const auto own = file::Folder::open(folder);
  if (own && described) {  // otherwise the files belong to another writer
    for (const char* name : {"recording.json", "frames.csv", "depth", "color", "points"})
      (void)own->remove(name);
  }
  std::for_each(made_folders.rbegin(), made_folders.rend(),
                [&](const fs::path& made) { fs::remove(made, ignored); });
}

RecordingWriter::RecordingWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter& RecordingWriter::operator=(RecordingWriter&&) noexcept = default;
RecordingWriter::~RecordingWriter() = default;

Result<RecordingWriter> RecordingWriter::create(const fs::path& folder,
                                                const SequenceHeader& header,
                                                const CaptureSettings& capture,
                                                ColorFileFormat color) {
  TURNSCAN_TRY(check_header(header));
  auto state = std::make_unique<State>();
  state->folder = folder;
  state->color = color;
  state->description = {header, capture, false, std::nullopt, {}};
  state->description.header.software = fmt::format("turnscan {}", version());
  const auto made = [&]() -> Result<> {
    TURNSCAN_TRY(make_folders(folder, state->made_folders));
    return state->create_files();
  }();
  if (!made) {
    state->discard();
    return tl::unexpected<Error>(made.error());
  }
  return RecordingWriter(std::move(state));
}

Result<RecordingWriter> RecordingWriter::extend(const fs::path& folder, ColorFileFormat color,
                                                std::optional<std::uint32_t> resumed_at,
                                                bool was_finished) {
  auto state = std::make_unique<State>();
  state->folder = folder;
  state->color = color;
  TURNSCAN_TRY(state->reopen_files(resumed_at, was_finished));
  return RecordingWriter(std::move(state));
}

Result<> RecordingWriter::append(const Frame& frame) {
  if (!state_ || state_->finished)
    throw std::invalid_argument("recording: append() after finish()");
  TURNSCAN_TRY(check_frame(frame, state_->description.header));
  TURNSCAN_TRY(state_->claim_index(frame.info));
  auto line = state_->write_files(frame);
  Result<> done = line ? state_->table.append(*line) : tl::unexpected<Error>(line.error());
  if (!done) state_->indices.erase(frame.info.index);
  return done;
}

Result<std::string> RecordingWriter::write_files(const Frame& frame) const {
  if (!state_ || state_->finished)
    throw std::invalid_argument("recording: write_files() after finish()");
  return state_->write_files(frame);
}

Result<> RecordingWriter::append_line(const FrameInfo& info, std::string_view line) {
  if (!state_ || state_->finished)
    throw std::invalid_argument("recording: append_line() after finish()");
  TURNSCAN_TRY(state_->claim_index(info));
  Result<> done = state_->table.append(line);
  if (!done) state_->indices.erase(info.index);
  return done;
}

void RecordingWriter::describe(const SequenceHeader& header, const CaptureSettings& capture) {
  if (header.sensors.size() != state_->description.header.sensors.size())
    throw std::invalid_argument("recording: the number of sensors cannot change");
  std::string software = std::move(state_->description.header.software);
  state_->description.header = header;
  state_->description.header.software = std::move(software);
  state_->description.capture = capture;
}

Result<> RecordingWriter::finish(Durability durability) {
  if (!state_ || state_->finished)
    throw std::invalid_argument("recording: finish() was called before");
  TURNSCAN_TRY(state_->table.sync(durability));
  RecordingDescription description = state_->description;
  description.complete = true;
  description.frame_count = static_cast<std::uint32_t>(state_->indices.size());
  TURNSCAN_TRY(
      write_file_atomically(state_->folder / "recording.json", recording_json(description)));
  state_->finished = true;
  return {};
}

namespace {

/// Reads one frame of a sequence; a dropped one has no data.
Result<Frame> frame_at(const FrameSequence& sequence, std::size_t position) {
  const FrameInfo& info = sequence.frames()[position];
  if (info.status != FrameStatus::kDropped) return sequence.read(position);
  Frame frame;
  frame.info = info;
  return frame;
}

}  // namespace

Result<> write_recording(const fs::path& folder, const FrameSequence& sequence,
                         const RunContext& context) {
  TURNSCAN_TRY(context.check());
  TURNSCAN_ASSIGN(RecordingWriter writer, RecordingWriter::create(folder, sequence.header()));
  RecordingWriter::State& state = *writer.state_;
  const std::size_t count = sequence.frames().size();
  auto written = [&]() -> Result<> {
    std::uint32_t stretch = 0;
    for (const FrameInfo& info : sequence.frames()) {
      TURNSCAN_TRY(state.claim_index(info));
      if (info.stretch != stretch) state.description.resumed_at.push_back(info.index);
      stretch = info.stretch;
    }
    context.begin_phase("write recording", count);
    for (std::size_t begin = 0; begin < count; begin += kBatch) {
      std::vector<std::string> lines(std::min(kBatch, count - begin));
      TURNSCAN_TRY(parallel_for(lines.size(), 1, context, [&](std::size_t i) -> Result<> {
        TURNSCAN_ASSIGN(const Frame frame, frame_at(sequence, begin + i));
        TURNSCAN_ASSIGN(lines[i], state.write_files(frame));
        context.advance();
        return {};
      }));
      TURNSCAN_TRY(state.table.append(fmt::format("{}", fmt::join(lines, ""))));
    }
    TURNSCAN_TRY(context.check());
    return writer.finish();
  }();
  if (!written) state.discard();
  return written;
}

}  // namespace turnscan
