#pragma once
// Ways to make the operating system say no.

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

namespace turnscan::testing {

/// While it lives, no file may grow beyond `bytes`: writes fail as they do on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit old_{};
  void (*old_handler_)(int) = nullptr;
};

/// While it lives, root is nobody, whom permissions stop. For others it does nothing.
class NoPrivileges {
 public:
  NoPrivileges() : was_root_(::geteuid() == 0) {
    if (was_root_) (void)!::seteuid(65534);
  }
  ~NoPrivileges() {
    if (was_root_) (void)!::seteuid(0);
  }
  NoPrivileges(const NoPrivileges&) = delete;
  NoPrivileges& operator=(const NoPrivileges&) = delete;

 private:
  bool was_root_;
};

}  // namespace turnscan::testing
