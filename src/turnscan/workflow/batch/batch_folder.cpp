#include <turnscan/workflow/batch/batch_folder.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <turnscan/core/version.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/file_lock.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::batch {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kLongestTaskFile = std::uint64_t(64) << 20;
constexpr std::size_t kLongestName = 150;

Result<> make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return fail_at(folder.string(), ErrorCode::kIo, "the folder cannot be made: {}", error.message());
}

bool has_other_content(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder, error) &&
         !(fs::is_directory(folder, error) && fs::is_empty(folder, error));
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
         c == '_' || c == '=' || c == '+' || c == '-';
}

Error with_path(Error error, const fs::path& path) {
  if (error.path.empty()) error.path = path.string();
  return error;
}

}  // namespace

Result<> check_task_name(const std::string& name) {
  if (!name.empty() && name.size() <= kLongestName && name.front() != '.' && name.front() != '-' &&
      std::all_of(name.begin(), name.end(), is_name_character))
    return {};
  return fail(ErrorCode::kInvalidOption,
              "'{}' cannot name a task; use up to {} letters, digits and ._=+-", name,
              kLongestName);
}

bool BatchFolder::planned() const {
  std::error_code error;
  return fs::exists(list_file(), error);
}

Result<> BatchFolder::save_plan(const std::vector<BatchTask>& tasks) const {
  if (!planned() && has_other_content(folder_))
    return fail_at(folder_.string(), ErrorCode::kAlreadyExists,
                   "there is something else than a batch; choose a new folder");
  TURNSCAN_TRY(make_folder(engine_folder()));
  text::OrderedJson list = text::OrderedJson::object();
  list["schema"] = 1;
  list["software"] = std::string("turnscan ") + version();
  list["tasks"] = text::OrderedJson::array();
  for (const BatchTask& task : tasks) {
    TURNSCAN_TRY(make_folder(task_folder(task.name)));
    const fs::path file = task_folder(task.name) / "task.json";
    const std::string text = task_json(task);
    const auto known = read_file(file, kLongestTaskFile);
    if (!known || *known != text)
      TURNSCAN_TRY(write_file_atomically(file, text, Durability::kNamed));
    list["tasks"].push_back(task.name);
  }
  return write_file_atomically(list_file(), list.dump(1) + "\n");
}

Result<std::vector<BatchTask>> BatchFolder::load_plan() const {
  if (!planned())
    return fail_at(folder_.string(), ErrorCode::kNotFound,
                   "there is no batch; begin one with 'turnscan batch run INPUT --out FOLDER'");
  TURNSCAN_ASSIGN(const std::string text, read_file(list_file()));
  const auto parsed = text::parse_json(text);
  if (!parsed) return tl::unexpected<Error>(with_path(parsed.error(), list_file()));
  const auto object = text::JsonObject::from(*parsed);
  if (!object) return tl::unexpected<Error>(with_path(object.error(), list_file()));
  const auto names = object->texts("tasks");
  if (!names) return tl::unexpected<Error>(with_path(names.error(), list_file()));
  std::vector<BatchTask> tasks;
  for (const std::string& name : *names) {
    TURNSCAN_ASSIGN(BatchTask task, load_task(name));
    tasks.push_back(std::move(task));
  }
  return tasks;
}

Result<BatchTask> BatchFolder::load_task(const std::string& name) const {
  TURNSCAN_TRY(check_task_name(name));
  const fs::path file = task_folder(name) / "task.json";
  TURNSCAN_ASSIGN(const std::string text, read_file(file, kLongestTaskFile));
  auto task = task_of(text);
  if (!task) return tl::unexpected<Error>(with_path(task.error(), file));
  task->name = name;
  if (auto fine = check_task(*task); !fine)
    return tl::unexpected<Error>(with_path(fine.error(), file));
  return task;
}

TaskRecord BatchFolder::record(const std::string& name) const {
  const auto text = read_file(state_file(name), kLongestTaskFile);
  if (!text) return {};
  auto record = record_of(*text);
  if (!record) return {};
  if (record->state == TaskState::kRunning && !file::FileLock::held(task_lock(name)))
    record->state = TaskState::kWaiting;
  return std::move(*record);
}

Result<> BatchFolder::save_record(const std::string& name, const TaskRecord& record) const {
  return write_file_atomically(
      state_file(name), record_json(record),
      record.state == TaskState::kDone ? Durability::kSynced : Durability::kNamed);
}

TaskRecord current_record(const BatchFolder& folder, const BatchTask& task) {
  TaskRecord record = folder.record(task.name);
  const bool ended = record.state == TaskState::kDone || record.state == TaskState::kFailed;
  if (!ended) return record;
  std::error_code error;
  const bool lost =
      record.state == TaskState::kDone && !fs::exists(folder.result_folder(task.name), error);
  if (lost || !is_current(task, record.digest, record.inputs)) record.state = TaskState::kWaiting;
  return record;
}

}  // namespace turnscan::batch
