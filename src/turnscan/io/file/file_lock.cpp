#include <turnscan/io/file/file_lock.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

namespace turnscan::file {

namespace {

constexpr auto kLongestPause = std::chrono::milliseconds(200);

struct flock whole_file() {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  return lock;
}

int open_lock(const Folder& folder, const std::string& name, int flags) {
  return ::openat(folder.descriptor(), name.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC | flags, 0666);
}

}  // namespace

Result<std::optional<FileLock>> FileLock::try_lock(const Folder& folder, const std::string& name) {
  FileLock made(open_lock(folder, name, O_CREAT));
  if (made.descriptor_ < 0)
    return fail_at((folder.path() / name).string(), ErrorCode::kIo, "the lock cannot be opened: {}",
                   std::generic_category().message(errno));
  struct flock lock = whole_file();
  if (::fcntl(made.descriptor_, F_OFD_SETLK, &lock) == 0)
    return std::optional<FileLock>(std::move(made));
  if (errno == EAGAIN || errno == EACCES) return std::optional<FileLock>();
  return fail_at((folder.path() / name).string(), ErrorCode::kIo,
                 "the lock cannot be acquired: {}; use a file system with locks",
                 std::generic_category().message(errno));
}

Result<FileLock> FileLock::wait(const Folder& folder, const std::string& name,
                                const RunContext& context) {
  auto pause = std::chrono::milliseconds(5);
  for (;;) {
    TURNSCAN_ASSIGN(std::optional<FileLock> lock, try_lock(folder, name));
    if (lock) return std::move(*lock);
    TURNSCAN_TRY(context.check());
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::milliseconds(kLongestPause));
  }
}

bool FileLock::held(const Folder& folder, const std::string& name) {
  const FileLock probe(open_lock(folder, name, 0));
  if (probe.descriptor_ < 0) return false;
  struct flock lock = whole_file();
  return ::fcntl(probe.descriptor_, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace turnscan::file
