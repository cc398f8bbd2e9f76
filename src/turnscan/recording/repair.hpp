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
  std::size_t without_line = 0;   ///< whole images that no line names: when they were taken is lost
  std::size_t leftovers = 0;      ///< half-written temporary files, removed now
  std::vector<std::string> done;  ///< one sentence for each thing that was done or lost
};

/// Makes frames.csv end with its last whole line, marks as dropped the frames whose files are not
/// whole, removes what half-written files are left, and marks the recording complete. Images are
/// never removed. Interrupted at any moment it leaves a recording that can be repaired again.
/// Fails as Recording::open() does, with kIo when the recording is still being written, or when the
/// folder may not be written.
Result<RepairReport> repair_recording(const std::filesystem::path& folder);

}  // namespace turnscan
