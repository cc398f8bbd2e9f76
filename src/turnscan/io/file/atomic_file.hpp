#pragma once
// Whole files: read with a limit, written so that a reader never sees half of one.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Nothing that turnscan reads is larger than this unless the caller says so.
inline constexpr std::uint64_t kMaxFileBytes = std::uint64_t(8) << 30;

/// The content of a regular file. Fails with kNotFound, with kIo (the system's words: permission,
/// a directory, a device), or with kResourceLimit when the file is longer than max_bytes.
Result<std::string> read_file(const std::filesystem::path& path,
                              std::uint64_t max_bytes = kMaxFileBytes);

/// Where the body of write_file_atomically puts its bytes. Buffered; not thread-safe.
class FileSink {
 public:
  ~FileSink();
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;

  /// Fails with kIo (disk full, ...). After a failure all later calls fail in the same way.
  Result<> write(std::span<const std::byte> bytes);
  Result<> write(std::string_view text);

 private:
  friend class AtomicFile;
  FileSink(int descriptor, std::string path);
  Result<> flush();
  Result<> write_through(const char* data, std::size_t size);

  int descriptor_;
  std::string path_;
  std::unique_ptr<char[]> buffer_;
  std::size_t used_ = 0;
  Result<> state_;
};

/// Whether the bytes must have reached the disk before the file gets its name.
enum class Durability {
  kSynced,  ///< survives a power cut: the old content or the new, never half of one
  kNamed    ///< survives the end of the process; much cheaper for many small files
};

/// Writes a temporary file in the folder of `path`, then renames it to `path`: readers see the old
/// content or the whole new one. On any failure (also of the body, whose error is passed on) the
/// temporary file is removed and `path` is left as it was. A symbolic link is followed; what is
/// not a regular file (a pipe, /dev/stdout) is written to directly. The folder must exist.
/// Fails with kNotFound (no such folder) or kIo (permission, disk full: the system's words).
Result<> write_file_atomically(const std::filesystem::path& path,
                               const std::function<Result<>(FileSink&)>& body,
                               Durability durability = Durability::kSynced);
Result<> write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes,
                               Durability durability = Durability::kSynced);
Result<> write_file_atomically(const std::filesystem::path& path, std::string_view text,
                               Durability durability = Durability::kSynced);

/// As write_file_atomically(), and the temporary file is read back before it takes the name: fails
/// with kIo, and leaves `path` as it was, when it does not hold what was written.
Result<> write_file_verified(const std::filesystem::path& path, std::string_view text);

}  // namespace turnscan
