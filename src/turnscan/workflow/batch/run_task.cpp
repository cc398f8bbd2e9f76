#include <turnscan/workflow/batch/run_task.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <system_error>
#include <thread>
#include <turnscan/core/process/background_process.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/file/file_lock.hpp>
#include <turnscan/workflow/batch/batch_folder.hpp>
#include <turnscan/workflow/batch/thumbnail.hpp>

namespace turnscan {

using namespace batch;

namespace {

namespace fs = std::filesystem;

constexpr auto kGrace = std::chrono::seconds(5);  // between SIGTERM and SIGKILL

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

Result<> remove_folder(const fs::path& folder) {
  std::error_code error;
  fs::remove_all(folder, error);
  if (!error) return {};
  return fail_at(folder.string(), ErrorCode::kIo, "the folder cannot be removed: {}",
                 error.message());
}

/// Removes what killed attempts left.
Result<> remove_leftovers(const fs::path& task_folder) {
  std::error_code error;
  std::vector<fs::path> old;
  for (const fs::directory_entry& entry : fs::directory_iterator(task_folder, error))
    if (entry.path().filename().string().starts_with("work-")) old.push_back(entry.path());
  for (const fs::path& folder : old) TURNSCAN_TRY(remove_folder(folder));
  return {};
}

/// The error of the command: the last line of its log that is one.
std::string reason_in(const fs::path& log, const process::ProcessEnd& end) {
  if (end.signal == 9)
    return "killed (signal 9): perhaps it needed more memory than there was; give it more, or "
           "fewer tasks at once (--jobs)";
  if (end.signal != 0) return fmt::format("ended by signal {}; see log.txt", end.signal);
  std::string reason = fmt::format("exit code {}; see log.txt", end.exit_code);
  const auto text = read_file(log);
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
  TaskRun(const BatchFolder& folder, const BatchTask& task, const TaskRunSettings& settings,
          const RunContext& context)
      : folder_(folder),
        task_(task),
        settings_(settings),
        context_(context),
        task_folder_(folder.task_folder(task.name)),
        work_(task_folder_ / fmt::format("work-{}-{}", host_name(), ::getpid())) {}

  Result<> run(const TaskRecord& before) {
    TURNSCAN_TRY(remove_leftovers(task_folder_));
    record_.state = TaskState::kRunning;
    record_.attempts = before.attempts + 1;
    record_.host = host_name();
    record_.started_s = seconds_since_1970();
    record_.threads = settings_.threads;
    TURNSCAN_TRY(folder_.save_record(task_.name, record_));
    const auto begin = std::chrono::steady_clock::now();
    Result<> made = make();
    record_.seconds = seconds_since(begin);
    if (!made && made.error().code == ErrorCode::kCancelled) {
      record_.state = TaskState::kWaiting;
      TURNSCAN_TRY(remove_folder(work_));
      TURNSCAN_TRY(folder_.save_record(task_.name, record_));
      return made;
    }
    if (!made) record_.reason = made.error().text();
    record_.state = made ? TaskState::kDone : TaskState::kFailed;
    if (!made) TURNSCAN_TRY(remove_folder(work_));
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
    std::error_code error;
    fs::create_directories(work_, error);
    if (error)
      return fail_at(work_.string(), ErrorCode::kIo, "the folder cannot be made: {}",
                     error.message());
    TURNSCAN_TRY(run_command());
    for (const InputPrint& input : record_.inputs) {
      const auto stamp = stamp_of(input.path);
      if (!stamp || *stamp != input.stamp)
        return fail_at(input.path, ErrorCode::kIo,
                       "the input changed while it was read; run the batch again");
    }
    draw_thumbnail(work_);
    return put_in_place();
  }

  Result<> run_command() {
    const fs::path log = task_folder_ / "log.txt";
    fs::path program = settings_.program;
    std::error_code error;
    fs::remove(log, error);
    const auto begin = std::chrono::steady_clock::now();
    TURNSCAN_ASSIGN(process::BackgroundProcess command,
                    process::BackgroundProcess::start(
                        program, arguments_of(task_, settings_.threads), log, work_));
    TURNSCAN_ASSIGN(const process::ProcessEnd end, wait_for_command(command, context_));
    record_.command_seconds = seconds_since(begin);
    record_.cpu_seconds = end.cpu_seconds;
    record_.peak_bytes = end.peak_bytes;
    if (end.exit_code == 0) return {};
    return fail(ErrorCode::kLibrary, "{}", reason_in(log, end));
  }

  /// The old result is removed first: until the record says done, the task has to be run again
  /// anyway.
  Result<> put_in_place() const {
    const fs::path result = folder_.result_folder(task_.name);
    TURNSCAN_TRY(remove_folder(result));
    std::error_code error;
    fs::rename(work_, result, error);
    if (!error) return {};
    return fail_at(result.string(), ErrorCode::kIo, "the result cannot be put in its place: {}",
                   error.message());
  }

  const BatchFolder& folder_;
  const BatchTask& task_;
  const TaskRunSettings& settings_;
  const RunContext& context_;
  const fs::path task_folder_, work_;
  TaskRecord record_;
};

}  // namespace

Result<> run_task(const fs::path& path, const std::string& name, const TaskRunSettings& settings,
                  const RunContext& context) {
  std::error_code error;
  const BatchFolder folder(fs::absolute(path, error));
  TURNSCAN_ASSIGN(const BatchTask task, folder.load_task(name));
  context.begin_phase(name, 0);
  TURNSCAN_ASSIGN(const file::FileLock lock, file::FileLock::wait(folder.task_lock(name), context));
  const TaskRecord before = current_record(folder, task);
  if (before.state == TaskState::kDone) return {};
  return TaskRun(folder, task, settings, context).run(before);
}

}  // namespace turnscan
