#pragma once
// Is a file whole? Looked at without decoding it.

#include <filesystem>
#include <string>
#include <turnscan/recording/frames_csv.hpp>

namespace turnscan::recording_format {

enum class FileState {
  kWhole,
  kLost,        ///< not there, empty or truncated: waiting does not bring it back
  kUnreadable,  ///< permission, a failing disk or network: it may be whole
  kNoResources  ///< this program has too many files open, or too little memory
};

struct FileCheck {
  FileState state = FileState::kWhole;
  std::string words;  ///< "is missing", "cannot be opened (Permission denied)"; empty when whole
};

/// PNG: ends with IEND. JPEG: ends with the end-of-image marker. PLY: not shorter than its header
/// says. Files with other endings need only be there and not be empty.
FileCheck check_file(const std::filesystem::path& path);

/// The same of the file that a frame's line names; a line without a name has lost its file.
FileCheck check_frame_file(const std::filesystem::path& folder, const FrameRow& row);

/// Whether the writer gave this name to a file that was not whole yet: .NAME.PID-COUNT.part
bool is_leftover(const std::string& name);

}  // namespace turnscan::recording_format
