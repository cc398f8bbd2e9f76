#include <turnscan/workflow/batch/batch_folder.hpp>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <turnscan/core/version.hpp>
#include <turnscan/io/file/file_lock.hpp>
#include <turnscan/io/text/json_fields.hpp>

namespace turnscan::batch {

namespace fs = std::filesystem;

namespace {

constexpr const char* kList = "batch.json";
constexpr const char* kTask = "task.json";
constexpr const char* kState = "state.json";
constexpr std::uint64_t kLongestTaskFile = std::uint64_t(64) << 20;
constexpr std::size_t kLongestName = 150;

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
  return fs::exists(folder_ / kList, error);
}

Result<file::Folder> BatchFolder::open() const {
  TURNSCAN_ASSIGN(file::Folder folder, file::Folder::open(folder_));
  TURNSCAN_TRY(folder.check_own());
  return folder;
}

Result<file::Folder> BatchFolder::open_task(const std::string& name) const {
  TURNSCAN_ASSIGN(const file::Folder folder, open());
  TURNSCAN_ASSIGN(const file::Folder tasks, folder.subfolder("tasks"));
  return tasks.subfolder(name);
}

Result<file::Folder> BatchFolder::open_engine() const {
  TURNSCAN_ASSIGN(const file::Folder folder, open());
  return folder.make_subfolder("engine");
}

Result<> BatchFolder::save_plan(const std::vector<BatchTask>& tasks) const {
  if (!planned() && has_other_content(folder_))
    return fail_at(folder_.string(), ErrorCode::kAlreadyExists,
                   "there is something else than a batch; choose a new folder");
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    return fail_at(folder_.string(), ErrorCode::kIo, "the folder cannot be made: {}",
                   error.message());
  TURNSCAN_ASSIGN(const file::Folder folder, open());
  TURNSCAN_TRY(folder.make_subfolder("engine"));
  TURNSCAN_ASSIGN(const file::Folder all, folder.make_subfolder("tasks"));
  text::OrderedJson list = text::OrderedJson::object();
  list["schema"] = 1;
  list["software"] = std::string("turnscan ") + version();
  list["tasks"] = text::OrderedJson::array();
  for (const BatchTask& task : tasks) {
    TURNSCAN_ASSIGN(const file::Folder own, all.make_subfolder(task.name));
    const std::string text = task_json(task);
    const auto known = own.read(kTask, kLongestTaskFile);
    if (!known || *known != text) TURNSCAN_TRY(own.write(kTask, text, Durability::kNamed));
    list["tasks"].push_back(task.name);
  }
  return folder.write(kList, list.dump(1) + "\n");
}

Result<std::vector<BatchTask>> BatchFolder::load_plan() const {
  if (!planned())
    return fail_at(folder_.string(), ErrorCode::kNotFound,
                   "there is no batch; begin one with 'turnscan batch run INPUT --out FOLDER'");
  TURNSCAN_ASSIGN(const std::string text, read_file(folder_ / kList));
  const auto parsed = text::parse_json(text);
  if (!parsed) return tl::unexpected<Error>(with_path(parsed.error(), folder_ / kList));
  const auto object = text::JsonObject::from(*parsed);
  if (!object) return tl::unexpected<Error>(with_path(object.error(), folder_ / kList));
  const auto names = object->texts("tasks");
  if (!names) return tl::unexpected<Error>(with_path(names.error(), folder_ / kList));
  std::vector<BatchTask> tasks;
  for (const std::string& name : *names) {
    TURNSCAN_ASSIGN(BatchTask task, load_task(name));
    tasks.push_back(std::move(task));
  }
  return tasks;
}

Result<BatchTask> BatchFolder::load_task(const std::string& name) const {
  TURNSCAN_TRY(check_task_name(name));
  TURNSCAN_ASSIGN(const file::Folder own, open_task(name));
  const fs::path file = own.path() / kTask;
  TURNSCAN_ASSIGN(const std::string text, own.read(kTask, kLongestTaskFile));
  auto task = task_of(text);
  if (!task) return tl::unexpected<Error>(with_path(task.error(), file));
  task->name = name;
  if (auto fine = check_task(*task); !fine)
    return tl::unexpected<Error>(with_path(fine.error(), file));
  return task;
}

TaskRecord BatchFolder::record(const std::string& name) const {
  const auto own = open_task(name);
  if (!own) return {};
  const auto text = own->read(kState, kLongestTaskFile);
  if (!text) return {};
  auto record = record_of(*text);
  if (!record) return {};
  if (record->state == TaskState::kRunning && !file::FileLock::held(*own, kLock))
    record->state = TaskState::kWaiting;
  return std::move(*record);
}

Result<> BatchFolder::save_record(const std::string& name, const TaskRecord& record) const {
  TURNSCAN_ASSIGN(const file::Folder own, open_task(name));
  return own.write(kState, record_json(record),
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
