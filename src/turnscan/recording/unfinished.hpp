#pragma once
// Remains of a writer that was killed.

#include <filesystem>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Whether the folder contains a recording that its writer did not finish, or the beginnings of
/// one, and nothing else. False for one that is currently being written, and for one that was
/// complete before more was appended to it.
bool is_unfinished_recording(const std::filesystem::path& folder);

/// Removes the files of such a recording; recording.json last, so that an interruption leaves an
/// unfinished recording. Fails with kInvalidOption if it is not one, with kIo.
Result<> remove_unfinished_recording(const std::filesystem::path& folder);

}  // namespace turnscan
