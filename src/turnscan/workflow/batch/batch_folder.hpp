#pragma once
// The folder of a batch: batch.json lists the tasks; tasks/NAME holds each task's task.json (what
// to do), state.json (its state and outcome), log.txt and result/.

#include <filesystem>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <turnscan/workflow/batch/task_state.hpp>
#include <vector>

namespace turnscan::batch {

class BatchFolder {
 public:
  explicit BatchFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  std::filesystem::path result_folder(const std::string& name) const {
    return folder_ / "tasks" / name / "result";
  }

  /// The folder itself, held open. Fails with kNotFound, kIo or, if it belongs to another user,
  /// kNoPermission.
  Result<file::Folder> open() const;
  /// A task's folder. Fails as open(), and with kNoPermission if a link leads to it.
  Result<file::Folder> open_task(const std::string& name) const;
  /// What engines write, created if necessary.
  Result<file::Folder> open_engine() const;

  /// Whether the folder holds a planned batch.
  bool planned() const;
  /// Creates the folders and writes the tasks that differ from those on disk, then the list. Fails
  /// with kAlreadyExists in a folder with other content, and with kIo.
  Result<> save_plan(const std::vector<BatchTask>& tasks) const;
  /// The tasks in the order of the list. Fails with kNotFound if there is no batch, else as reading
  /// its files does.
  Result<std::vector<BatchTask>> load_plan() const;
  Result<BatchTask> load_task(const std::string& name) const;

  /// The state of a task. A task without a state, or with a damaged one, is waiting. A running task
  /// whose lock nobody holds was killed and counts as waiting.
  TaskRecord record(const std::string& name) const;
  Result<> save_record(const std::string& name, const TaskRecord& record) const;

  static constexpr const char* kLock = "lock";  ///< of a batch in its folder, of a task in its own
  static constexpr const char* kResult = "result";

 private:
  std::filesystem::path folder_;
};

/// The current state of a task: as record(), but waiting if a done or failed task has changed
/// since.
TaskRecord current_record(const BatchFolder& folder, const BatchTask& task);

/// Succeeds if the text can be the name of a task's folder. Fails with kInvalidOption.
Result<> check_task_name(const std::string& name);

}  // namespace turnscan::batch
