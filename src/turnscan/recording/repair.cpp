#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <system_error>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/recording/file_check.hpp>
#include <turnscan/recording/frames_csv.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/recording_json.hpp>
#include <turnscan/recording/repair.hpp>

namespace turnscan::recording_format {

namespace fs = std::filesystem;

namespace {

/// A lock on frames.csv, which a writer holds as long as it is at work.
class TableLock {
 public:
  explicit TableLock(const fs::path& table)
      : descriptor_(::open(table.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    held_ = descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  }
  ~TableLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  TableLock(const TableLock&) = delete;
  TableLock& operator=(const TableLock&) = delete;
  bool held() const { return held_; }

 private:
  int descriptor_;
  bool held_ = true;
};

Result<std::string> table_text(const fs::path& folder) {
  const fs::path path = folder / "frames.csv";
  std::error_code error;
  if (!fs::exists(path, error)) return frames_csv_header();
  TURNSCAN_ASSIGN(std::string text, read_file(path, kMaxTableBytes));
  return text.find('\n') == std::string::npos ? frames_csv_header() : text;
}

std::string line_of(const FrameRow& row, bool whole) {
  FrameInfo info = row.info;
  if (whole) return frames_csv_line(info, row.color_file);
  info.status = FrameStatus::kDropped;
  info.file.clear();
  return frames_csv_line(info, "");
}

bool has_whole_file(const fs::path& folder, const FrameRow& row) {
  return !row.info.file.empty() && defect_of_file(folder / row.info.file).empty();
}

/// The table with whole lines only. A table with columns of others keeps its lines as they are.
struct MendedTable {
  std::string text;
  std::set<std::string> named;  ///< files that a line names
  std::size_t rows = 0;
};

Result<MendedTable> mend(const fs::path& folder, std::size_t sensors, RepairReport& report) {
  TURNSCAN_ASSIGN(const std::string text, table_text(folder));
  auto table = parse_frames_csv(text, sensors);
  if (!table) {
    Error error = std::move(table).error();
    error.path = (folder / "frames.csv").string();
    return tl::unexpected<Error>(std::move(error));
  }
  report.done = table->notes;
  const bool ours = text.starts_with(frames_csv_header());
  MendedTable out;
  out.text = frames_csv_header();
  for (FrameRow& row : table->rows) {
    const bool was_dropped = row.info.status == FrameStatus::kDropped;
    bool whole = !was_dropped && has_whole_file(folder, row);
    if (!row.color_file.empty() && !defect_of_file(folder / row.color_file).empty())
      row.color_file.clear();
    out.named.insert(row.info.file);
    out.text += line_of(row, whole);
    report.frames += whole ? 1 : 0;
    report.dropped += whole || was_dropped ? 0 : 1;
  }
  out.rows = table->rows.size();
  if (!ours) out.text = text.substr(0, text.find_last_of('\n') + 1);
  return out;
}

/// Files of this writer that were not whole when it ended: .NAME.part
void remove_leftovers(const fs::path& folder, RepairReport& report) {
  std::error_code error;
  for (const char* name : {".", "depth", "color", "points"}) {
    for (const auto& entry : fs::directory_iterator(folder / name, error)) {
      const std::string file = entry.path().filename().string();
      if (!file.starts_with('.') || !file.ends_with(".part") || !entry.is_regular_file(error))
        continue;
      if (fs::remove(entry.path(), error)) ++report.leftovers;
    }
  }
}

void count_without_line(const fs::path& folder, const std::set<std::string>& named,
                        RepairReport& report) {
  std::error_code error;
  for (const char* name : {"depth", "points"}) {
    for (const auto& entry : fs::directory_iterator(folder / name, error)) {
      const std::string file = std::string(name) + "/" + entry.path().filename().string();
      if (entry.path().filename().string().starts_with('.') || named.count(file) > 0) continue;
      ++report.without_line;
    }
  }
}

void tell(RepairReport& report) {
  const auto say = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) report.done.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
  };
  say(report.dropped, "frame was lost: its file is not whole; it is marked dropped now",
      "frames were lost: their files are not whole; they are marked dropped now");
  say(report.without_line,
      "image is not part of the recording: the writer ended before its line; it was left in place",
      "images are not part of the recording: the writer ended before their lines; they were left "
      "in place");
  say(report.leftovers, "half-written file was removed", "half-written files were removed");
}

}  // namespace

}  // namespace turnscan::recording_format

namespace turnscan {

using namespace recording_format;
namespace fs = std::filesystem;

Result<RepairReport> repair_recording(const fs::path& folder) {
  const fs::path json = folder / "recording.json", csv = folder / "frames.csv";
  TURNSCAN_TRY(Recording::open(folder));  // its refusals are the right ones
  const TableLock lock(csv);
  if (!lock.held())
    return fail_at(folder.string(), ErrorCode::kIo,
                   "it is being recorded just now; wait until the recording has ended");
  TURNSCAN_ASSIGN(const std::string text, read_file(json, kMaxDescriptionBytes));
  TURNSCAN_ASSIGN(RecordingDescription description, parse_recording_json(text));
  RepairReport report;
  report.was_complete = description.complete;
  TURNSCAN_ASSIGN(const MendedTable table, mend(folder, description.header.sensors.size(), report));
  count_without_line(folder, table.named, report);
  TURNSCAN_TRY(write_file_atomically(csv, table.text));
  description.complete = true;
  description.frame_count = static_cast<std::uint32_t>(table.rows);
  TURNSCAN_TRY(write_file_atomically(json, recording_json(description)));
  remove_leftovers(folder, report);
  tell(report);
  return report;
}

}  // namespace turnscan
