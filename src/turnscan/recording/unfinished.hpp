#pragma once
// What a writer leaves that was killed.

#include <filesystem>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Whether the folder holds a recording that its writer did not finish, or the beginnings of one,
/// and nothing else. False for one that is being written just now, and for one that was complete
/// before more was added to it.
bool is_unfinished_recording(const std::filesystem::path& folder);

/// Removes what such a recording consists of; recording.json goes last, so that it stays an
/// unfinished one when this is interrupted. Fails with kInvalidOption when it is none, with kIo.
Result<> remove_unfinished_recording(const std::filesystem::path& folder);

}  // namespace turnscan
