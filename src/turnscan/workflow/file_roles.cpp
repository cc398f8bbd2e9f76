#include <turnscan/workflow/file_roles.hpp>

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

using FileId = std::pair<dev_t, ino_t>;

/// Of a regular file, symbolic links followed.
std::optional<FileId> id_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileId(status.st_dev, status.st_ino);
}

/// A file that does not exist yet is known by its name.
std::string name_of_file(const std::string& path) {
  std::error_code error;
  const fs::path full = fs::weakly_canonical(path, error);
  return error ? path : full.string();
}

Result<> check_outputs_differ(const std::vector<std::string>& outputs) {
  std::map<FileId, std::string> ids;
  std::set<std::string> names;
  for (const std::string& output : outputs) {
    const auto id = id_of(output);
    // What is neither a file nor absent (/dev/stdout) may get several outputs.
    std::error_code error;
    if (output.empty() || (!id && fs::exists(output, error))) continue;
    const bool twice =
        !names.insert(name_of_file(output)).second || (id && !ids.emplace(*id, output).second);
    if (twice)
      return fail_at(output, ErrorCode::kInvalidOption,
                     "two outputs would be written to this file; give them different names");
  }
  return {};
}

/// An input that holds the folder is read beside it (a data set, its recording within it).
Result<> check_input_stays(const std::string& input, const std::string& removed) {
  std::error_code error;
  if (input.empty() || removed.empty() || !fs::exists(removed, error)) return {};
  const fs::path folder = fs::canonical(removed, error);
  for (fs::path path = fs::canonical(input, error); !error; path = path.parent_path()) {
    if (path == folder)
      return fail_at(removed, ErrorCode::kInvalidOption,
                     "it would be removed, but {} is read from it; choose another name", input);
    if (path == path.parent_path()) break;
  }
  return {};
}

/// Looks into folders only when an output exists that they could hold.
class InputSearch {
 public:
  explicit InputSearch(const std::vector<std::string>& outputs) {
    for (const std::string& output : outputs)
      if (const auto id = id_of(output)) outputs_.emplace(*id, output);
  }

  Result<> check(const std::string& input) const {
    if (outputs_.empty() || input.empty()) return {};
    TURNSCAN_TRY(check_file(input, input));
    std::error_code error;
    if (!fs::is_directory(input, error)) return {};
    const auto options = fs::directory_options::skip_permission_denied;
    for (fs::recursive_directory_iterator file(input, options, error), end; !error && file != end;
         file.increment(error))
      TURNSCAN_TRY(check_file(file->path(), input));
    return {};
  }

 private:
  Result<> check_file(const fs::path& file, const std::string& input) const {
    const auto id = id_of(file);
    const auto output = id ? outputs_.find(*id) : outputs_.end();
    if (output == outputs_.end()) return {};
    return fail_at(output->second, ErrorCode::kInvalidOption,
                   "the output would take the place of {}, which is read; choose another name",
                   file == input ? "the input " + input : file.string() + " of " + input);
  }

  std::map<FileId, std::string> outputs_;
};

}  // namespace

Result<> check_file_roles(const FileRoles& roles) {
  TURNSCAN_TRY(check_outputs_differ(roles.outputs));
  const InputSearch search(roles.outputs);
  for (const std::string& input : roles.inputs) {
    TURNSCAN_TRY(search.check(input));
    TURNSCAN_TRY(check_input_stays(input, roles.removed));
  }
  return {};
}

}  // namespace turnscan
