#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace turnscan::recording_format {

namespace fs = std::filesystem;

/// A lock on frames.csv, which a writer holds while it is active.
class TableLock {
 public:
  explicit TableLock(const fs::path& table)
      : descriptor_(::open(table.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    held_ = descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  }
  ~TableLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  TableLock(const TableLock&) = delete;
  TableLock& operator=(const TableLock&) = delete;
  bool held() const { return held_; }

 private:
  int descriptor_;
  bool held_ = true;
};

}  // namespace turnscan::recording_format
