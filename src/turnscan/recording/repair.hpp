#pragma once
// Completes a recording whose writer was interrupted.

#include <cstddef>
#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan {

struct RepairReport {
  bool was_complete = true;       ///< nothing had to be repaired
  std::size_t frames = 0;         ///< number that can be read now
  std::size_t dropped = 0;        ///< lines newly marked dropped, because their file is incomplete
  std::size_t unreadable = 0;     ///< lines left unchanged: their file exists but cannot be read
  std::string first_unreadable;   ///< the first of them, and why
  std::size_t without_line = 0;   ///< complete images that no line names: their capture times are
                                  ///< lost
  std::size_t leftovers = 0;      ///< half-written temporary files that were removed
  std::vector<std::string> kept;  ///< names of the copies of the files that were replaced
  std::vector<std::string> done;  ///< one sentence for each action or loss
};

/// Makes frames.csv end with its last complete line, marks frames as dropped whose files are
/// missing or truncated, removes remains of half-written files, and marks the recording complete.
/// Everything else in both files is preserved byte by byte: names of lost files, columns and fields
/// of other programs. The replaced file is kept beside the new one (frames.csv.before-repair),
/// which is read back before it takes the name. Images are never removed, and symbolic links to
/// other folders are not followed. If interrupted at any moment, it leaves a recording that can be
/// repaired again. Fails as Recording::open() does (with kCancelled before anything is replaced),
/// and with kIo if the recording is still being written or the folder is not writable.
Result<RepairReport> repair_recording(const std::filesystem::path& folder,
                                      const RunContext& context = RunContext());

}  // namespace turnscan
