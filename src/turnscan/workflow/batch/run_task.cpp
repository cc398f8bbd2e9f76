#include <turnscan/workflow/batch/run_task.hpp>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>
#include <turnscan/core/process/background_process.hpp>
#include <turnscan/core/process/host_name.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/file/file_lock.hpp>
#include <turnscan/workflow/batch/batch_folder.hpp>
#include <turnscan/workflow/batch/thumbnail.hpp>

namespace turnscan {

using namespace batch;

namespace {

namespace fs = std::filesystem;

constexpr const char* kLog = "log.txt";
constexpr auto kGrace = std::chrono::seconds(5);  // between SIGTERM and SIGKILL

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

// In each folder that a task's outputs are made in, so that only such a folder is ever deleted.
constexpr const char* kMark = ".made-by-batch";

/// Removes a folder with outputs, or an empty one; leaves any other as it is.
Result<> remove_outputs(const file::Folder& task, const std::string& name) {
  const auto outputs = task.subfolder(name);
  if (!outputs || (!outputs->has(kMark) && !outputs->names().empty())) return {};
  return task.remove(name);
}

/// Removes what killed attempts left.
Result<> remove_leftovers(const file::Folder& task) {
  for (const std::string& name : task.names())
    if (name.starts_with("work-")) TURNSCAN_TRY(remove_outputs(task, name));
  return {};
}

/// The error of the command: the last line of its log that is one.
std::string reason_in(const file::Folder& task, const process::ProcessEnd& end) {
  if (end.signal == 9)
    return "killed (signal 9): perhaps it needed more memory than there was; give it more, or "
           "fewer tasks at once (--jobs)";
  if (end.signal != 0) return fmt::format("ended by signal {}; see log.txt", end.signal);
  std::string reason = fmt::format("exit code {}; see log.txt", end.exit_code);
  const auto text = task.read(kLog);
  if (!text) return reason;
  constexpr std::string_view kBegin = "turnscan: ";
  std::size_t at = text->rfind("\n" + std::string(kBegin));
  at = at != std::string::npos ? at + 1 : text->starts_with(kBegin) ? 0 : text->size();
  if (at == text->size()) return reason;
  at += kBegin.size();
  return text->substr(at, text->find('\n', at) - at);
}

/// Waits for the command; terminates it when the context is cancelled.
Result<process::ProcessEnd> wait_for_command(process::BackgroundProcess& command,
                                             const RunContext& context) {
  auto pause = std::chrono::milliseconds(1);
  std::optional<std::chrono::steady_clock::time_point> asked;
  for (;;) {
    if (const auto end = command.poll()) {
      TURNSCAN_TRY(context.check());
      return *end;
    }
    const auto now = std::chrono::steady_clock::now();
    if (context.cancelled() && !asked) {
      command.stop(false);
      asked = now;
    }
    if (asked && now - *asked > kGrace) command.stop(true);
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::milliseconds(20));
  }
}

class TaskRun {
 public:
  TaskRun(const BatchFolder& folder, const file::Folder& own, const BatchTask& task,
          const TaskRunSettings& settings, const RunContext& context)
      : folder_(folder),
        task_(task),
        settings_(settings),
        context_(context),
        own_(own),
        work_(fmt::format("work-{}-{}", process::host_name(), ::getpid())) {}

  Result<> run(const TaskRecord& before) {
    TURNSCAN_TRY(remove_leftovers(own_));
    record_.state = TaskState::kRunning;
    record_.attempts = before.attempts + 1;
    record_.host = process::host_name();
    record_.started_s = seconds_since_1970();
    record_.threads = settings_.threads;
    TURNSCAN_TRY(folder_.save_record(task_.name, record_));
    const auto begin = std::chrono::steady_clock::now();
    Result<> made = make();
    record_.seconds = seconds_since(begin);
    if (!made && made.error().code == ErrorCode::kCancelled) {
      record_.state = TaskState::kWaiting;
      TURNSCAN_TRY(remove_outputs(own_, work_));
      TURNSCAN_TRY(folder_.save_record(task_.name, record_));
      return made;
    }
    if (!made) record_.reason = made.error().text();
    record_.state = made ? TaskState::kDone : TaskState::kFailed;
    if (!made) TURNSCAN_TRY(remove_outputs(own_, work_));
    return folder_.save_record(task_.name, record_);
  }

 private:
  /// Makes the result and puts it in place.
  Result<> make() {
    auto prints = prints_of(task_);
    if (!prints) {
      record_.digest = digest_of(task_, {});
      return tl::unexpected<Error>(std::move(prints).error());
    }
    record_.inputs = std::move(*prints);
    record_.digest = digest_of(task_, record_.inputs);
    TURNSCAN_ASSIGN(const file::Folder work, own_.make_subfolder(work_));
    TURNSCAN_TRY(work.write(kMark, task_.name + "\n", Durability::kNamed));
    TURNSCAN_TRY(run_command(work));
    for (const InputPrint& input : record_.inputs) {
      const auto stamp = stamp_of(input.path);
      if (!stamp || *stamp != input.stamp)
        return fail_at(input.path, ErrorCode::kIo,
                       "the input changed while it was read; run the batch again");
    }
    draw_thumbnail(work.anchor());
    return put_in_place();
  }

  Result<> run_command(const file::Folder& work) {
    TURNSCAN_TRY(own_.remove(kLog));
    const auto begin = std::chrono::steady_clock::now();
    TURNSCAN_ASSIGN(
        process::BackgroundProcess command,
        process::BackgroundProcess::start(settings_.program, arguments_of(task_, settings_.threads),
                                          own_.anchor() / kLog, work.anchor()));
    TURNSCAN_ASSIGN(const process::ProcessEnd end, wait_for_command(command, context_));
    record_.command_seconds = seconds_since(begin);
    record_.cpu_seconds = end.cpu_seconds;
    record_.peak_bytes = end.peak_bytes;
    if (end.exit_code == 0) return {};
    return fail(ErrorCode::kLibrary, "{}", reason_in(own_, end));
  }

  /// The old result is there until the new one is. If the batch did not make it, it is kept.
  Result<> put_in_place() const {
    const auto before = own_.subfolder(BatchFolder::kResult);
    const bool made =
        before ? before->has(kMark) || before->names().empty() : !own_.has(BatchFolder::kResult);
    TURNSCAN_TRY(own_.exchange(work_, BatchFolder::kResult));
    return made ? own_.remove(work_) : own_.exchange(work_, "kept-" + work_);
  }

  const BatchFolder& folder_;
  const BatchTask& task_;
  const TaskRunSettings& settings_;
  const RunContext& context_;
  const file::Folder& own_;
  const std::string work_;
  TaskRecord record_;
};

}  // namespace

Result<> run_task(const fs::path& path, const std::string& name, const TaskRunSettings& settings,
                  const RunContext& context) {
  std::error_code error;
  const BatchFolder folder(fs::absolute(path, error));
  TURNSCAN_ASSIGN(const BatchTask task, folder.load_task(name));
  context.begin_phase(name, 0);
  TURNSCAN_ASSIGN(const file::Folder own, folder.open_task(name));
  TURNSCAN_ASSIGN(const file::FileLock lock,
                  file::FileLock::wait(own, BatchFolder::kLock, context));
  const TaskRecord before = current_record(folder, task);
  if (before.state == TaskState::kDone) return {};
  return TaskRun(folder, own, task, settings, context).run(before);
}

}  // namespace turnscan
