#include <turnscan/workflow/input.hpp>

#include <turnscan/recording/recording.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRecordingFile = "recording.json";

}  // namespace

Result<Input> open_input(const fs::path& path, const ImportOptions& options) {
  std::error_code error;
  const bool named = path.filename() == kRecordingFile;
  if (!named && !fs::exists(path / kRecordingFile, error)) {
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
