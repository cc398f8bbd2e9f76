#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/recording/file_check.hpp>
#include <turnscan/recording/recording_json.hpp>
#include <turnscan/recording/table_lock.hpp>
#include <turnscan/recording/unfinished.hpp>

namespace turnscan {

namespace fs = std::filesystem;

namespace {

constexpr const char* kDescription = "recording.json";
constexpr std::array<const char*, 6> kParts{kDescription, "frames.csv", "depth",
                                            "color",      "points",     "truth"};

bool is_part(const std::string& name) {
  // A repair keeps what it replaced; a recording is repaired before it is resumed.
  for (const char* kept : {"recording.json.before-repair", "frames.csv.before-repair"})
    if (name.starts_with(kept)) return true;
  return recording_format::is_leftover(name) ||
         std::find(kParts.begin(), kParts.end(), name) != kParts.end();
}

}  // namespace

bool is_unfinished_recording(const fs::path& folder) {
  std::error_code error;
  bool described = false, some = false;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!is_part(name)) return false;
    described |= name == kDescription;
    some |= !recording_format::is_leftover(name);
  }
  if (error) return false;
  if (!described) return !some && !fs::is_empty(folder, error);
  const auto text = read_file(folder / kDescription, recording_format::kMaxDescriptionBytes);
  if (!text) return false;
  const auto description = recording_format::parse_recording_json(*text);
  // With a number of frames it was complete before a pass was added, and must not be removed.
  return description && !description->complete && !description->frame_count &&
         recording_format::TableLock(folder / "frames.csv").held();
}

Result<> remove_unfinished_recording(const fs::path& folder) {
  if (!is_unfinished_recording(folder))
    return fail_at(folder.string(), ErrorCode::kInvalidOption,
                   "it is no unfinished recording; choose another folder");
  const auto removed = [&]() -> Result<> {
    TURNSCAN_ASSIGN(const file::Folder own, file::Folder::open(folder));
    for (const std::string& name : own.names())
      if (name != kDescription) TURNSCAN_TRY(own.remove(name));
    return own.remove(kDescription);
  }();
  if (removed) return {};
  return fail_at(removed.error().path, ErrorCode::kIo, "{}; check permissions",
                 removed.error().message);
}

}  // namespace turnscan
