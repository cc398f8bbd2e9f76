#pragma once
// Decodes whole files.

#include <filesystem>
#include <new>
#include <stdexcept>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::file {

/// Fails as read_file() does if the file does not exist or cannot be opened.
Result<> check_readable(const std::filesystem::path& path);

/// Reads a file and decodes it; adds the path to errors, and reports lack of memory as an error.
template <class Decode>
auto decode_file(const std::filesystem::path& path, const Decode& decode)
    -> decltype(decode(std::string_view())) {
  try {
    TURNSCAN_ASSIGN(const std::string bytes, read_file(path));
    auto value = decode(std::string_view(bytes));
    if (!value && value.error().path.empty()) value.error().path = path.string();
    return value;
  } catch (const std::bad_alloc&) {
    return fail_at(path.string(), ErrorCode::kResourceLimit, "not enough memory to read the file");
  }
}

}  // namespace turnscan::file
