#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <turnscan/core/process/program_folders.hpp>

namespace turnscan::process {

namespace fs = std::filesystem;

namespace {

bool is_inside(const fs::path& path, const fs::path& folder) {
  const auto [rest, ignored] =
      std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return rest == folder.end();
}

/// A private group of the user, as Debian and Fedora create for each user.
bool is_private_group(gid_t group) {
  const passwd* user = ::getpwuid(::geteuid());
  return user != nullptr && user->pw_gid == group && group == ::geteuid();
}

std::string distrust(const struct stat& status) {
  if (status.st_uid != 0 && status.st_uid != ::geteuid()) return "belongs to another user";
  const bool sticky = S_ISDIR(status.st_mode) && (status.st_mode & S_ISVTX) != 0;
  const bool by_group = (status.st_mode & S_IWGRP) != 0 && !is_private_group(status.st_gid);
  if (((status.st_mode & S_IWOTH) != 0 || by_group) && !sticky) return "can be written by others";
  return {};
}

}  // namespace

std::vector<fs::path> own_folders(const fs::path& relative) {
  std::vector<fs::path> folders;
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return folders;
  if (folder.filename() == "bin") folders.push_back(folder.parent_path() / relative);
  const fs::path build = TURNSCAN_BUILD_TREE;
  if (is_inside(folder, build)) folders.push_back(build / relative);
  return folders;
}

Result<std::vector<fs::path>> folders_of_variable(const char* name) {
  std::vector<fs::path> folders;
  const char* value = ::secure_getenv(name);
  std::string_view text = value == nullptr ? "" : value;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(':'), text.size());
    const fs::path folder = text.substr(0, end);
    if (!folder.empty() && !folder.is_absolute())
      return fail(ErrorCode::kInvalidOption,
                  "{}: '{}' is not an absolute path; write it from the root on", name,
                  folder.string());
    if (!folder.empty()) folders.push_back(folder);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return folders;
}

Result<fs::path> trusted(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::canonical(path, error);
  if (error)
    return fail_at(path.string(), ErrorCode::kNotFound, "it cannot be found ({}); check the path",
                   error.message());
  // Whoever can write to a folder above the program could replace the program itself: a checkout
  // owned by another user adds no further risk.
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (fs::path at = whole; !is_inside(program, at); at = at.parent_path()) {
    struct stat status {};
    const std::string why =
        ::stat(at.c_str(), &status) != 0 ? "cannot be looked at" : distrust(status);
    if (!why.empty())
      return fail_at(path.string(), ErrorCode::kNoPermission,
                     "{} {}, so that this program could be told to run foreign code; give it to "
                     "root or yourself, with 'chmod go-w'",
                     at.string(), why);
    if (at == at.root_path()) break;
  }
  return whole;
}

}  // namespace turnscan::process
