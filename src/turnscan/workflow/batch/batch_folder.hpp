#pragma once
// The folder of a batch: batch.json names the tasks, tasks/NAME holds each one's task.json (what is
// to be done), state.json (what became of it), log.txt and result/.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <turnscan/workflow/batch/task_state.hpp>
#include <vector>

namespace turnscan::batch {

class BatchFolder {
 public:
  explicit BatchFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path list_file() const { return folder_ / "batch.json"; }
  std::filesystem::path lock_file() const { return folder_ / "lock"; }
  std::filesystem::path engine_folder() const { return folder_ / "engine"; }
  std::filesystem::path task_folder(const std::string& name) const {
    return folder_ / "tasks" / name;
  }
  std::filesystem::path result_folder(const std::string& name) const {
    return task_folder(name) / "result";
  }
  std::filesystem::path state_file(const std::string& name) const {
    return task_folder(name) / "state.json";
  }
  std::filesystem::path task_lock(const std::string& name) const {
    return task_folder(name) / "lock";
  }

  /// Whether a batch was planned there.
  bool planned() const;
  /// Makes the folders, and writes the tasks that are not as they lie there, then the list. Fails
  /// with kAlreadyExists in a folder with other content, and with kIo.
  Result<> save_plan(const std::vector<BatchTask>& tasks) const;
  /// In the order of the list. Fails with kNotFound without a batch, else as reading its files.
  Result<std::vector<BatchTask>> load_plan() const;
  Result<BatchTask> load_task(const std::string& name) const;

  /// A task that has no state, or a damaged one, is waiting. A running one that nobody holds the
  /// lock of was killed: waiting.
  TaskRecord record(const std::string& name) const;
  Result<> save_record(const std::string& name, const TaskRecord& record) const;

 private:
  std::filesystem::path folder_;
};

/// What a task amounts to now: as record(), and waiting where what is done or failed is no longer
/// what the task asks for.
TaskRecord current_record(const BatchFolder& folder, const BatchTask& task);

/// Succeeds when text can name a task's folder. Fails with kInvalidOption.
Result<> check_task_name(const std::string& name);

}  // namespace turnscan::batch
