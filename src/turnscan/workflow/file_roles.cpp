#include <turnscan/workflow/file_roles.hpp>

#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <turnscan/workflow/mesh_output.hpp>
#include <utility>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

using FileId = std::pair<dev_t, ino_t>;

/// Identity of a regular file, following symbolic links.
std::optional<FileId> id_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileId(status.st_dev, status.st_ino);
}

/// A file that does not exist yet is identified by its name.
std::string name_of_file(const std::string& path) {
  std::error_code error;
  const fs::path full = fs::weakly_canonical(path, error);
  return error ? path : full.string();
}

bool is_number(std::string_view text) {
  return !text.empty() && text.front() != '0' &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a file name is OUT-1, OUT-2, ... for this output, as numbered by write_objects(), or
/// OUT-pass2, OUT-pass2-1, ..., as named by mesh_of_pass().
bool is_numbered(const fs::path& name, const fs::path& out) {
  const std::string stem = name.stem().string(), begin = out.stem().string();
  if (name.extension() != out.extension() || !stem.starts_with(begin)) return false;
  std::string_view rest = std::string_view(stem).substr(begin.size());
  constexpr std::string_view kPass = "-pass";
  if (rest.starts_with(kPass)) {
    rest.remove_prefix(kPass.size());
    const std::string_view pass = rest.substr(0, rest.find('-'));
    if (!is_number(pass)) return false;
    rest.remove_prefix(pass.size());
    if (rest.empty()) return true;
  }
  return numbers_objects(out.string()) && rest.starts_with('-') && is_number(rest.substr(1));
}

/// The numbered files that already exist.
std::vector<std::string> numbered_files(const std::string& out) {
  std::vector<std::string> files;
  if (out.empty()) return files;
  const fs::path parent = fs::path(out).parent_path();
  std::error_code error;
  for (fs::directory_iterator file(parent.empty() ? "." : parent, error), end;
       !error && file != end; file.increment(error))
    if (is_numbered(file->path().filename(), out)) files.push_back(file->path().string());
  return files;
}

/// Compares an output by its own name, and existing files by any name.
Result<> check_numbered_differ(const FileRoles& roles) {
  if (roles.numbered.empty()) return {};
  std::set<FileId> ids;
  for (const std::string& file : numbered_files(roles.numbered))
    if (const auto id = id_of(file)) ids.insert(*id);
  const fs::path out = name_of_file(roles.numbered);
  for (const std::string& output : roles.outputs) {
    if (output.empty() || output == roles.numbered) continue;
    const auto id = id_of(output);
    const fs::path name = name_of_file(output);
    if ((name.parent_path() == out.parent_path() && is_numbered(name.filename(), out)) ||
        (id && ids.count(*id) > 0))
      return fail_at(output, ErrorCode::kInvalidOption,
                     "two outputs would be written to this file, as several objects and "
                     "passes are numbered after {}; give them different names",
                     roles.numbered);
  }
  return {};
}

Result<> check_outputs_differ(const std::vector<std::string>& outputs) {
  std::map<FileId, std::string> ids;
  std::set<std::string> names;
  for (const std::string& output : outputs) {
    const auto id = id_of(output);
    // Something that is neither a file nor absent (/dev/stdout) may be the target of several
    // outputs.
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

/// An input that contains the folder is read without it (a data set with its recording inside).
Result<> check_input_stays(const std::string& input, const std::string& removed) {
  std::error_code error;
  if (input.empty() || removed.empty() || !fs::exists(removed, error)) return {};
  const fs::path folder = fs::canonical(removed, error);
  for (fs::path path = fs::canonical(input, error); !error; path = path.parent_path()) {
    if (path == folder)
      return fail_at(removed, ErrorCode::kInvalidOption,
                     "it would be removed or changed, but {} is read from it; choose another name",
                     input);
    if (path == path.parent_path()) break;
  }
  return {};
}

/// Searches folders only if an output exists that they could contain.
class InputSearch {
 public:
  explicit InputSearch(const FileRoles& roles) {
    add(roles.outputs);
    add(numbered_files(roles.numbered));
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
  void add(const std::vector<std::string>& outputs) {
    for (const std::string& output : outputs)
      if (const auto id = id_of(output)) outputs_.emplace(*id, output);
  }

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
  TURNSCAN_TRY(check_numbered_differ(roles));
  const InputSearch search(roles);
  for (const std::string& input : roles.inputs) {
    TURNSCAN_TRY(search.check(input));
    TURNSCAN_TRY(check_input_stays(input, roles.removed));
  }
  return {};
}

}  // namespace turnscan
