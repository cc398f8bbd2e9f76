#include <turnscan/workflow/input.hpp>

#include <turnscan/io/file/existence.hpp>
#include <turnscan/recording/recording.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordingFile = "recording.json";

}  // namespace

Result<Input> open_input(const fs::path& path, const ImportOptions& options) {
  TURNSCAN_TRY(file::check_exists(path, "file or folder"));
  const bool named = path.filename() == kRecordingFile;
  TURNSCAN_ASSIGN(const bool recording_there, file::is_there(path / kRecordingFile));
  if (!named && !recording_there) {
    TURNSCAN_ASSIGN(auto frames, open_foreign(path, options));
    return Input{std::move(frames), {}};
  }
  const fs::path folder = !named ? path : path.has_parent_path() ? path.parent_path() : ".";
  TURNSCAN_ASSIGN(Recording recording, Recording::open(folder));
  Input out;
  out.notes = recording.notes();
  out.frames = std::make_unique<Recording>(std::move(recording));
  return out;
}

}  // namespace turnscan
