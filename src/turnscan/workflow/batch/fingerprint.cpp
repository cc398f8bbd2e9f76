#include <turnscan/workflow/batch/fingerprint.hpp>

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <turnscan/core/version.hpp>
#include <turnscan/io/file/sha256.hpp>

namespace turnscan::batch {

namespace fs = std::filesystem;

namespace {

struct PrintedFile {
  std::string name;  ///< relative; empty for a single file, so that it may be moved
  fs::path path;
};

bool is_no_path(const std::string& input) { return input.starts_with("builtin:"); }

/// Sorted by name: the order of a folder's entries depends on the file system.
Result<std::vector<PrintedFile>> files_below(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status))
    return fail_at(path, ErrorCode::kNotFound, "the input is not there; check the path");
  if (!fs::is_directory(status)) return std::vector<PrintedFile>{{"", path}};
  std::vector<PrintedFile> files;
  for (fs::recursive_directory_iterator at(path, error), end; !error && at != end;
       at.increment(error))
    if (at->is_regular_file(error))
      files.push_back({at->path().lexically_relative(path).string(), at->path()});
  if (error) return fail_at(path, ErrorCode::kIo, "the folder cannot be read: {}", error.message());
  std::sort(files.begin(), files.end(),
            [](const PrintedFile& a, const PrintedFile& b) { return a.name < b.name; });
  return files;
}

Result<std::string> file_stamp(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return fail_at(path.string(), ErrorCode::kIo, "the file cannot be looked at: {}",
                   std::generic_category().message(errno));
  return fmt::format("{} {}.{:09}", status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec);
}

/// Fields are prefixed with their length, so that different lists never give the same bytes.
void add_field(file::Sha256& sum, const std::string& text) {
  sum.add(fmt::format("{}:", text.size()));
  sum.add(text);
}

template <class TextOf>
Result<std::string> hash_files(const std::string& path, const TextOf& text_of) {
  file::Sha256 sum;
  if (is_no_path(path)) {
    add_field(sum, path);
    return file::hex_of(sum.finish());
  }
  TURNSCAN_ASSIGN(const std::vector<PrintedFile> files, files_below(path));
  for (const PrintedFile& printed : files) {
    TURNSCAN_ASSIGN(const std::string text, text_of(printed.path));
    add_field(sum, printed.name);
    add_field(sum, text);
  }
  return file::hex_of(sum.finish());
}

}  // namespace

Result<std::string> stamp_of(const std::string& path) { return hash_files(path, file_stamp); }

Result<InputPrint> print_of(const std::string& path) {
  InputPrint print{path, {}, {}};
  TURNSCAN_ASSIGN(print.stamp, stamp_of(path));
  TURNSCAN_ASSIGN(print.sha256, hash_files(path, file::sha256_of_file));
  return print;
}

Result<std::vector<InputPrint>> prints_of(const BatchTask& task) {
  std::vector<InputPrint> prints;
  for (const std::string& path : files_of(task)) {
    TURNSCAN_ASSIGN(InputPrint print, print_of(path));
    prints.push_back(std::move(print));
  }
  return prints;
}

std::string digest_of(const BatchTask& task, const std::vector<InputPrint>& inputs) {
  file::Sha256 sum;
  add_field(sum, std::string("turnscan ") + version());
  for (std::string word : arguments_of(task, 0)) {
    // The result depends on the content of an input, not on its location.
    for (const InputPrint& input : inputs) {
      const auto at = is_no_path(input.path) ? std::string::npos : word.find(input.path);
      if (at != std::string::npos) word.erase(at, input.path.size());
    }
    add_field(sum, word);
  }
  for (const InputPrint& input : inputs) add_field(sum, input.sha256);
  return file::hex_of(sum.finish());
}

bool is_current(const BatchTask& task, const std::string& digest,
                const std::vector<InputPrint>& inputs) {
  const std::vector<std::string> files = files_of(task);
  std::vector<InputPrint> now;
  for (const std::string& path : files) {
    const auto known = std::find_if(inputs.begin(), inputs.end(),
                                    [&](const InputPrint& print) { return print.path == path; });
    const auto stamp = stamp_of(path);
    if (!stamp) return false;
    if (known != inputs.end() && known->stamp == *stamp) {
      now.push_back(*known);
      continue;
    }
    auto print = print_of(path);
    if (!print) return false;
    now.push_back(std::move(*print));
  }
  return digest_of(task, now) == digest;
}

}  // namespace turnscan::batch
