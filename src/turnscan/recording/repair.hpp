#pragma once
// Finishes a recording whose writer did not get so far.

#include <cstddef>
#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

struct RepairReport {
  bool was_complete = true;       ///< there was nothing to finish
  std::size_t frames = 0;         ///< that can be read now
  std::size_t dropped = 0;        ///< lines marked dropped now, because their file is not whole
  std::size_t unreadable = 0;     ///< lines left alone: their file is there but cannot be read
  std::string first_unreadable;   ///< the first of them, and why
  std::size_t without_line = 0;   ///< whole images that no line names: when they were taken is lost
  std::size_t leftovers = 0;      ///< half-written temporary files, removed now
  std::vector<std::string> kept;  ///< names of the copies of the files that were replaced
  std::vector<std::string> done;  ///< one sentence for each thing that was done or lost
};

/// Makes frames.csv end with its last whole line, marks as dropped the frames whose files are gone
/// or truncated, removes what half-written files are left, and marks the recording complete. All
/// else in both files stays byte by byte: names of lost files, columns and fields of others. The
/// file that is replaced is kept beside the new one (frames.csv.before-repair), which is read back
/// before it takes the name. Images are never removed, symbolic links not followed to other
/// folders. Interrupted at any moment it leaves a recording that can be repaired again. Fails as
/// Recording::open() does, with kIo when the recording is still being written, or when the folder
/// may not be written.
Result<RepairReport> repair_recording(const std::filesystem::path& folder);

}  // namespace turnscan
