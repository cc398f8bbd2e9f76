#include <set>
#include <system_error>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/io/text/json_bytes.hpp>
#include <turnscan/recording/file_check.hpp>
#include <turnscan/recording/frames_csv.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/recording/recording_json.hpp>
#include <turnscan/recording/repair.hpp>
#include <turnscan/recording/repaired_frames_csv.hpp>
#include <turnscan/recording/table_lock.hpp>

namespace turnscan::recording_format {

namespace fs = std::filesystem;

namespace {

/// Empty if there is no table.
Result<std::string> table_text(const fs::path& folder) {
  auto text = read_file(folder / "frames.csv", kMaxTableBytes);
  if (!text && text.error().code == ErrorCode::kNotFound) return std::string();
  return text;
}

/// The current state of the frames: lost ones are marked dropped.
struct Inspection {
  std::vector<FrameRow> rows;
  std::set<std::string> named;  ///< files that a line names
};

Result<Inspection> inspect(const fs::path& folder, std::vector<FrameRow> rows, RepairReport& report,
                           const RunContext& context) {
  Inspection out;
  for (FrameRow& row : rows) {
    TURNSCAN_TRY(context.check());
    out.named.insert(row.info.file);
    if (row.info.status == FrameStatus::kDropped) continue;
    const FileCheck check = check_frame_file(folder, row);
    report.frames += check.state == FileState::kWhole ? 1 : 0;
    report.dropped += check.state == FileState::kLost ? 1 : 0;
    if (check.state == FileState::kLost) row.info.status = FrameStatus::kDropped;
    if (check.state == FileState::kWhole || check.state == FileState::kLost ||
        ++report.unreadable > 1)
      continue;
    report.first_unreadable = fmt::format("{} {}", row.info.file, check.words);
  }
  out.rows = std::move(rows);
  return out;
}

/// The new frames.csv, and its number of lines.
struct NewTable {
  std::string text;
  std::set<std::string> named;
  std::size_t rows = 0;
};

Result<NewTable> new_table(const fs::path& folder, const std::string& text, std::size_t sensors,
                           RepairReport& report, const RunContext& context) {
  if (text.find('\n') == std::string::npos) return NewTable{frames_csv_header(), {}, 0};
  auto table = parse_frames_csv(text, sensors, context);
  if (!table) {
    Error error = std::move(table).error();
    error.path = (folder / "frames.csv").string();
    return tl::unexpected<Error>(std::move(error));
  }
  report.done = table->notes;
  TURNSCAN_ASSIGN(Inspection inspection, inspect(folder, std::move(table->rows), report, context));
  TURNSCAN_ASSIGN(std::string mended, repaired_frames_csv(text, inspection.rows, sensors, context));
  return NewTable{std::move(mended), std::move(inspection.named), inspection.rows.size()};
}

/// recording.json with its two fields about completeness set, and all others unchanged.
Result<std::string> completed_description(std::string text, std::size_t frames) {
  text = text::with_json_member(std::move(text), "complete", "true");
  text = text::with_json_member(std::move(text), "frame_count", fmt::format("{}", frames));
  const auto back = parse_recording_json(text);
  if (back && back->complete && back->frame_count == frames) return text;
  return fail(ErrorCode::kLibrary,
              "recording.json cannot be marked complete; set its field \"complete\" by hand");
}

/// A name beside the file that is free, or already has the same content.
Result<fs::path> keep_old(const fs::path& path, const std::string& text) {
  for (int i = 1; i < 1000; ++i) {
    fs::path kept = path;
    kept += i == 1 ? ".before-repair" : fmt::format(".before-repair-{}", i);
    const auto there = read_file(kept);
    if (there && *there == text) return kept;
    if (there || there.error().code != ErrorCode::kNotFound) continue;
    TURNSCAN_TRY(write_file_verified(kept, text));
    return kept;
  }
  return fail_at(path.string(), ErrorCode::kAlreadyExists,
                 "999 files of earlier repairs lie beside it; remove some");
}

Result<> replace(const fs::path& path, const std::string& before, const std::string& after,
                 RepairReport& report) {
  if (before == after) return {};
  if (!before.empty()) {
    TURNSCAN_ASSIGN(const fs::path kept, keep_old(path, before));
    report.kept.push_back(kept.filename().string());
  }
  return write_file_verified(path, after);
}

/// The entries of a folder of this recording; none if a symbolic link leads to it, since its files
/// belong to others.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> out;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return out;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (fs::is_regular_file(entry.symlink_status(error))) out.push_back(entry.path());
  }
  return out;
}

void remove_leftovers_in(const file::Folder& folder, RepairReport& report) {
  std::error_code error;
  for (const std::string& name : folder.names()) {
    const bool left =
        is_leftover(name) && fs::is_regular_file(fs::symlink_status(folder.anchor() / name, error));
    if (left && folder.remove(name)) ++report.leftovers;
  }
}

void remove_leftovers(const fs::path& folder, RepairReport& report) {
  const auto own = file::Folder::open(folder);
  if (!own) return;
  remove_leftovers_in(*own, report);
  for (const char* name : {"depth", "color", "points"})
    if (const auto part = own->subfolder(name)) remove_leftovers_in(*part, report);
}

void count_without_line(const fs::path& folder, const std::set<std::string>& named,
                        RepairReport& report) {
  for (const char* name : {"depth", "points"}) {
    for (const fs::path& path : files_in(folder / name)) {
      const std::string file = path.filename().string();
      if (!file.starts_with('.') && named.count(std::string(name) + "/" + file) == 0)
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
  if (report.unreadable > 0)
    report.done.push_back(fmt::format(
        "{} {}: {}; nothing was changed there, and what can be read again counts again",
        report.unreadable,
        report.unreadable == 1 ? "frame cannot be read just now" : "frames cannot be read just now",
        report.first_unreadable));
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

Result<RepairReport> repair_recording(const fs::path& folder, const RunContext& context) {
  const fs::path json = folder / "recording.json", csv = folder / "frames.csv";
  TURNSCAN_TRY(Recording::open(folder, context));  // it rejects with the right errors
  const TableLock lock(csv);
  if (!lock.held())
    return fail_at(folder.string(), ErrorCode::kIo,
                   "it is being recorded just now; wait until the recording has ended");
  TURNSCAN_ASSIGN(const std::string text, read_file(json, kMaxDescriptionBytes));
  TURNSCAN_ASSIGN(const RecordingDescription description, parse_recording_json(text));
  RepairReport report;
  report.was_complete = description.complete;
  TURNSCAN_ASSIGN(const std::string old_table, table_text(folder));
  TURNSCAN_ASSIGN(const NewTable table,
                  new_table(folder, old_table, description.header.sensors.size(), report, context));
  TURNSCAN_ASSIGN(const std::string completed, completed_description(text, table.rows));
  count_without_line(folder, table.named, report);
  TURNSCAN_TRY(context.check());
  TURNSCAN_TRY(replace(csv, old_table, table.text, report));
  TURNSCAN_TRY(replace(json, text, completed, report));
  remove_leftovers(folder, report);
  tell(report);
  return report;
}

}  // namespace turnscan
