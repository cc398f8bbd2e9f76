#pragma once
// A file that one process at a time may hold, on this machine or, where the file system passes
// locks on (NFS, Lustre, GPFS), on any that mounts it.

#include <filesystem>
#include <optional>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::file {

/// A lock of the open file (fcntl F_OFD_SETLK): it ends with this object or its process, however
/// that ends, so that none is ever left behind. The file, empty, stays.
class FileLock {
 public:
  /// Makes the file if need be. nullopt: another holds it. Fails with kIo, also where the file
  /// system has no locks.
  static Result<std::optional<FileLock>> try_lock(const std::filesystem::path& path);
  /// Waits until no other holds it. Fails as try_lock(), and with kCancelled.
  static Result<FileLock> wait(const std::filesystem::path& path, const RunContext& context);
  /// Whether somebody else holds it; does not take it.
  static bool held(const std::filesystem::path& path);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace turnscan::file
