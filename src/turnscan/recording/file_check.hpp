#pragma once
// Checks whether a file is complete without decoding it.

#include <filesystem>
#include <string>
#include <turnscan/recording/frames_csv.hpp>

namespace turnscan::recording_format {

enum class FileState {
  kWhole,
  kLost,        ///< missing, empty or truncated: waiting does not bring it back
  kUnreadable,  ///< permission, a failing disk or network: it may be complete
  kNoResources  ///< this program has too many files open, or too little memory
};

struct FileCheck {
  FileState state = FileState::kWhole;
  std::string words;  ///< "is missing", "cannot be opened (Permission denied)"; empty if the file
                      ///< is complete
};

/// PNG: ends with IEND. JPEG: ends with the end-of-image marker. PLY: not shorter than its header
/// states. Files with other extensions must only exist and not be empty.
FileCheck check_file(const std::filesystem::path& path);

/// The same for the file that a frame's line names; a line without a name has lost its file.
FileCheck check_frame_file(const std::filesystem::path& folder, const FrameRow& row);

/// Whether the name is that of a writer's temporary file, which was not complete yet:
/// .NAME.PID-COUNT.part
bool is_leftover(const std::string& name);

}  // namespace turnscan::recording_format
