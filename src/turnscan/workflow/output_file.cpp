#include <turnscan/workflow/output_file.hpp>

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/recording/unfinished.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

Result<> check_writable(const fs::path& folder, const std::string& path) {
  if (access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return fail_at(path, ErrorCode::kIo, "the folder {} cannot be written to ({}); choose another",
                 folder.string(), std::strerror(errno));
}

}  // namespace

std::string ending_of(const std::string& path) {
  std::string ending = fs::path(path).extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

std::string with_suffix(const std::string& path, const std::string& suffix) {
  const fs::path p(path);
  return (p.parent_path() / (p.stem().string() + suffix + p.extension().string())).string();
}

Result<> check_output_file(const std::string& path, const std::string& ending) {
  if (path.empty()) return {};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  // Devices and pipes (/dev/stdout) are written to directly, whatever their name.
  const bool special = fs::exists(status) && fs::is_other(status);
  if (!special && ending_of(path) != ending)
    return fail_at(path, ErrorCode::kInvalidOption, "the name must end in {}; rename it", ending);
  if (fs::is_directory(status))
    return fail_at(path, ErrorCode::kInvalidOption, "there is a folder of that name; rename it");
  if (special) return {};
  const fs::path folder = folder_of(path);
  TURNSCAN_ASSIGN(const bool there, file::is_there(folder));
  if (!there)
    return fail_at(path, ErrorCode::kNotFound, "the folder {} does not exist; make it first",
                   folder.string());
  if (!fs::is_directory(folder, error))
    return fail_at(path, ErrorCode::kIo, "{} is not a folder; choose another place",
                   folder.string());
  return check_writable(folder, path);
}

Result<> check_output_folder(const std::string& path, bool overwrite_unfinished) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) {
    if (is_unfinished_recording(path)) {
      if (overwrite_unfinished) return check_writable(path, path);
      return fail_at(path, ErrorCode::kAlreadyExists,
                     "an unfinished recording lies there, whose program was ended; go on with it "
                     "with --resume if a sensor records it, keep what it has with 'turnscan info "
                     "--repair', make it again with --overwrite-unfinished, or choose another "
                     "name");
    }
    if (!fs::is_empty(path, error) || error)
      return fail_at(path, ErrorCode::kAlreadyExists,
                     "the folder has content and is never overwritten; choose another name");
    return check_writable(path, path);
  }
  if (fs::exists(status))
    return fail_at(path, ErrorCode::kAlreadyExists, "a file has that name; choose another name");
  fs::path above = fs::absolute(path, error).lexically_normal();
  while (!above.empty() && !fs::exists(above, error) && above != above.parent_path())
    above = above.parent_path();
  if (!fs::is_directory(above, error))
    return fail_at(path, ErrorCode::kIo, "{} is not a folder; choose another place",
                   above.string());
  return check_writable(above, path);
}

Result<> clear_output_folder(const std::string& path, bool overwrite_unfinished) {
  if (overwrite_unfinished && is_unfinished_recording(path))
    TURNSCAN_TRY(remove_unfinished_recording(path));
  return check_output_folder(path);
}

}  // namespace turnscan
