#include <turnscan/workflow/batch/find_recordings.hpp>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <turnscan/io/import/importers.hpp>

namespace turnscan::batch {

namespace fs = std::filesystem;

namespace {

constexpr int kDeepest = 4;

bool holds(const fs::path& folder, const char* name) {
  std::error_code error;
  return fs::exists(folder / name, error);
}

/// Whether a file identifies itself: any program's JSON or .conf may be among recordings.
bool is_file_of_a_sensor(const fs::directory_entry& entry) {
  std::error_code error;
  if (!entry.is_regular_file(error)) return false;
  const fs::path ending = entry.path().extension();
  return ending != ".json" && ending != ".conf" && is_foreign(entry.path());
}

void find_below(const fs::path& folder, const std::string& prefix, int depth,
                std::vector<FoundRecording>& found) {
  std::vector<fs::path> inner;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory(error) || is_file_of_a_sensor(entry)) inner.push_back(entry.path());
  std::sort(inner.begin(), inner.end());
  for (const fs::path& path : inner) {
    const std::string name = prefix + path.filename().string();
    if (!fs::is_directory(path, error)) {
      found.push_back({prefix + path.stem().string(), path.string()});
    } else if (holds(path, "recording.json") ||
               (holds(path, "metadata.yaml") && is_foreign(path))) {
      found.push_back({name, path.string()});
    } else if (depth < kDeepest && !holds(path, "batch.json")) {
      find_below(path, name + "_", depth + 1, found);
    }
  }
}

/// Finds the results of a batch of simulations.
void find_results(const fs::path& batch, std::vector<FoundRecording>& found) {
  std::vector<fs::path> tasks;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(batch / "tasks", error))
    tasks.push_back(entry.path());
  std::sort(tasks.begin(), tasks.end());
  for (const fs::path& task : tasks)
    if (holds(task / "result" / "recording", "recording.json"))
      found.push_back({task.filename().string(), (task / "result" / "recording").string()});
}

}  // namespace

Result<std::vector<FoundRecording>> find_recordings(const std::string& folder) {
  std::error_code error;
  if (fs::is_regular_file(folder, error) && is_foreign(folder))
    return std::vector<FoundRecording>{{fs::path(folder).stem().string(), folder}};
  if (!fs::is_directory(folder, error))
    return fail_at(folder, ErrorCode::kNotFound,
                   "there is no such folder; name a recording, a folder of recordings or a table");
  std::vector<FoundRecording> found;
  fs::path path(folder);
  if (path.filename().empty()) path = path.parent_path();
  if (holds(path, "recording.json")) {
    found.push_back({path.filename().string(), path.string()});
  } else if (holds(path, "batch.json")) {
    find_results(path, found);
  } else {
    find_below(path, "", 1, found);
    if (found.empty() && is_foreign(path))
      found.push_back({path.filename().string(), path.string()});
  }
  if (!found.empty()) return found;
  return fail_at(
      folder, ErrorCode::kNotFound,
      "there is no recording in it; name a recording, a folder of recordings or a table");
}

}  // namespace turnscan::batch
