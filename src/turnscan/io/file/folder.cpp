#include <turnscan/io/file/folder.hpp>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

namespace turnscan::file {

namespace fs = std::filesystem;

namespace {

constexpr int kFolderFlags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

tl::unexpected<Error> folder_error(const fs::path& path, std::string_view what) {
  const int error = errno;
  return fail_at(path.string(), error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, "{}: {}",
                 what, std::generic_category().message(error));
}

}  // namespace

Result<Folder> Folder::open(const fs::path& path) {
  Folder folder(::open(path.c_str(), kFolderFlags), path);
  if (folder.descriptor_ < 0) return folder_error(path, "the folder cannot be opened");
  return folder;
}

Result<Folder> Folder::subfolder(const std::string& name) const {
  Folder folder(::openat(descriptor_, name.c_str(), kFolderFlags | O_NOFOLLOW), path_ / name);
  if (folder.descriptor_ < 0) {
    struct stat status {};
    const int error = errno;
    const bool link = ::fstatat(descriptor_, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                      S_ISLNK(status.st_mode);
    errno = error;
    if (!link) return folder_error(folder.path_, "the folder cannot be opened");
    return fail_at(folder.path_.string(), ErrorCode::kNoPermission,
                   "it is a symbolic link, and nothing is written or deleted behind one; put a "
                   "folder in its place");
  }
  TURNSCAN_TRY(folder.check_own());
  return folder;
}

Result<Folder> Folder::make_subfolder(const std::string& name) const {
  if (::mkdirat(descriptor_, name.c_str(), 0777) != 0 && errno != EEXIST)
    return folder_error(path_ / name, "the folder cannot be made");
  return subfolder(name);
}

Folder::Folder(Folder&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), path_(std::move(other.path_)) {}

Folder& Folder::operator=(Folder&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(path_, other.path_);
  return *this;
}

Folder::~Folder() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

fs::path Folder::anchor() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

Result<> Folder::check_own() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0)
    return folder_error(path_, "the folder cannot be looked at");
  if (status.st_uid == 0 || status.st_uid == ::geteuid()) return {};
  return fail_at(path_.string(), ErrorCode::kNoPermission,
                 "the folder belongs to another user; choose one of your own");
}

bool Folder::has(const std::string& name) const {
  struct stat status {};
  return ::fstatat(descriptor_, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
}

std::vector<std::string> Folder::names() const {
  std::vector<std::string> names;
  // Of its own, since reading moves the position in an open folder.
  const int descriptor = ::openat(descriptor_, ".", kFolderFlags);
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(
      descriptor < 0 ? nullptr : ::fdopendir(descriptor), ::closedir);
  if (!entries) {
    if (descriptor >= 0) ::close(descriptor);
    return names;
  }
  while (const dirent* entry = ::readdir(entries.get()))
    if (const std::string_view name = entry->d_name; name != "." && name != "..")
      names.emplace_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

Result<> Folder::remove(const std::string& name) const {
  if (::unlinkat(descriptor_, name.c_str(), 0) == 0 || errno == ENOENT) return {};
  if (errno != EISDIR) return folder_error(path_ / name, "cannot remove");
  // From the descriptor's path; below it, remove_all() follows no link either.
  std::error_code error;
  fs::remove_all(anchor() / name, error);
  if (!error) return {};
  return fail_at((path_ / name).string(), ErrorCode::kIo, "cannot remove: {}", error.message());
}

Result<> Folder::exchange(const std::string& from, const std::string& to) const {
  const auto renamed = [&](const std::string& a, const std::string& b, unsigned flags) {
    return ::renameat2(descriptor_, a.c_str(), descriptor_, b.c_str(), flags) == 0;
  };
  if (renamed(from, to, RENAME_EXCHANGE)) return {};
  const bool alone = errno == ENOENT;  // perhaps nothing has the name `to` yet
  if (!alone && errno != EINVAL && errno != ENOSYS)
    return folder_error(path_ / to, "cannot be put in its place");
  // Some file systems cannot exchange.
  const std::string aside = from + ".old";
  if (!alone && !renamed(to, aside, 0))
    return folder_error(path_ / to, "cannot be put in its place");
  if (!renamed(from, to, 0)) {
    const auto failed = folder_error(path_ / to, "cannot be put in its place");
    if (!alone) (void)renamed(aside, to, 0);
    return failed;
  }
  if (!alone && !renamed(aside, from, 0)) return folder_error(path_ / aside, "cannot be renamed");
  return {};
}

}  // namespace turnscan::file
