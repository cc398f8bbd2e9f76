#pragma once
// A file lock that one process at a time may hold, on this machine or, if the file system
// propagates locks (NFS, Lustre, GPFS), on any machine that mounts it.

#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/io/file/folder.hpp>

namespace turnscan::file {

/// A lock on the open file (fcntl F_OFD_SETLK): it ends with this object or its process, however
/// that ends, so that no stale lock remains. The empty file is kept.
class FileLock {
 public:
  /// Creates the file if necessary. nullopt: another process holds the lock. Fails with kIo, also
  /// if the file system does not support locks.
  static Result<std::optional<FileLock>> try_lock(const Folder& folder, const std::string& name);
  /// Waits until no other process holds the lock. Fails as try_lock(), and with kCancelled.
  static Result<FileLock> wait(const Folder& folder, const std::string& name,
                               const RunContext& context);
  /// Whether another process holds the lock; does not take it.
  static bool held(const Folder& folder, const std::string& name);

  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();

 private:
  explicit FileLock(int descriptor) : descriptor_(descriptor) {}
  int descriptor_ = -1;
};

}  // namespace turnscan::file
