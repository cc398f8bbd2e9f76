#include <turnscan/workflow/batch/batch_run.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <thread>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/io/file/file_lock.hpp>
#include <turnscan/workflow/batch/batch_folder.hpp>
#include <turnscan/workflow/batch/batch_summary.hpp>
#include <turnscan/workflow/engine/local_engine.hpp>
#include <turnscan/workflow/engine/slurm_engine.hpp>

namespace turnscan {

using namespace batch;

namespace {

namespace fs = std::filesystem;

Result<file::FileLock> lock_batch(const BatchFolder& folder) {
  TURNSCAN_ASSIGN(const file::Folder open, folder.open());
  TURNSCAN_ASSIGN(auto lock, file::FileLock::try_lock(open, BatchFolder::kLock));
  if (lock) return std::move(*lock);
  return fail_at(folder.path().string(), ErrorCode::kAlreadyExists,
                 "another turnscan is at work on this batch; wait for it, or stop it first");
}

std::string full_path(const std::string& folder) {
  std::error_code error;
  const fs::path full = fs::weakly_canonical(fs::absolute(folder, error), error);
  return error ? folder : full.string();
}

int core_count() { return static_cast<int>(std::max(1u, std::thread::hardware_concurrency())); }

/// A task to be run.
struct Due {
  const BatchTask* task = nullptr;
  int attempts_before = 0;
  int restarts = 0;
};

class BatchRunner {
 public:
  BatchRunner(const BatchRequest& request, const RunContext& context)
      : request_(request), context_(context), folder_(full_path(request.folder)) {}

  Result<BatchOutcome> run() {
    const auto begin = std::chrono::steady_clock::now();
    TURNSCAN_ASSIGN(tasks_, folder_.load_plan());
    TURNSCAN_ASSIGN(const file::FileLock lock, lock_batch(folder_));
    TURNSCAN_TRY(check_names());
    TURNSCAN_TRY(find_due());
    Result<> ran = due_.empty() ? Result<>() : run_due();
    if (!ran && ran.error().code != ErrorCode::kCancelled)
      return tl::unexpected<Error>(std::move(ran).error());
    const BatchSummary summary = summarize(folder_, tasks_);
    TURNSCAN_ASSIGN(outcome_.files, write_summary(summary, folder_));
    if (!ran)
      return fail(ErrorCode::kCancelled,
                  "batch: stopped with {} of {} tasks done; run it again to go on",
                  summary.count(TaskState::kDone), tasks_.size());
    outcome_.tasks = tasks_.size();
    outcome_.done = summary.count(TaskState::kDone);
    outcome_.failed = summary.count(TaskState::kFailed);
    outcome_.waiting = outcome_.tasks - outcome_.done - outcome_.failed;
    outcome_.seconds = seconds_since(begin);
    return outcome_;
  }

 private:
  Result<> check_names() const {
    for (const std::string& name : request_.retry) {
      const bool known = std::any_of(tasks_.begin(), tasks_.end(),
                                     [&](const BatchTask& task) { return task.name == name; });
      if (!known)
        return fail(ErrorCode::kInvalidOption,
                    "{}: there is no such task; see 'turnscan batch "
                    "status {}'",
                    name, request_.folder);
    }
    return {};
  }

  bool is_due(const std::string& name, TaskState state) const {
    const bool named =
        std::find(request_.retry.begin(), request_.retry.end(), name) != request_.retry.end();
    if (!request_.retry.empty() && request_.retry_failed) return named;
    if (state == TaskState::kDone) return false;
    return state != TaskState::kFailed || request_.retry_failed;
  }

  Result<> find_due() {
    context_.begin_phase("look for what is done", tasks_.size());
    for (const BatchTask& task : tasks_) {
      TURNSCAN_TRY(context_.check());
      const TaskRecord record = current_record(folder_, task);
      if (record.state == TaskState::kDone) ++outcome_.skipped;
      if (is_due(task.name, record.state)) due_[task.name] = {&task, record.attempts, 0};
      context_.advance();
    }
    return {};
  }

  /// Longest first, so that at the end no core waits for a task that began late.
  std::vector<engine::Job> jobs_for(const std::set<std::string>& names) const {
    std::vector<const BatchTask*> order;
    for (const BatchTask& task : tasks_)
      if (names.contains(task.name)) order.push_back(&task);
    std::stable_sort(order.begin(), order.end(),
                     [](const BatchTask* a, const BatchTask* b) { return a->frames > b->frames; });
    std::vector<engine::Job> jobs;
    for (const BatchTask* task : order) jobs.push_back({task->name, task->peak_bytes});
    return jobs;
  }

  Result<std::unique_ptr<engine::Engine>> make_engine() const {
    const BatchRunOptions& o = request_.options;
    const bool slurm = o.engine == BatchEngine::kSlurm;
    const int cores = core_count(),
              tasks = static_cast<int>(std::min<std::size_t>(due_.size(), 4096));
    const int jobs =
        o.jobs.value_or(std::min(tasks, std::max(1, cores / o.task_threads.value_or(1))));
    const int spare = slurm ? 1 : std::max(1, cores / jobs);
    engine::JobCommand command{request_.program,
                               {"batch", "task", folder_.path().string()},
                               o.task_threads.value_or(spare)};
    command.arguments.push_back(fmt::format("--task-threads={}", command.threads));
    command.arguments.emplace_back("--quiet");
    TURNSCAN_ASSIGN(file::Folder folder, folder_.open_engine());
    if (slurm)
      return engine::make_slurm_engine(command, {o.engine_options, o.tasks_per_job},
                                       std::move(folder), context_);
    if (!o.engine_options.empty())
      return fail(ErrorCode::kInvalidOption, "--engine-options: there are none of --engine local");
    return engine::make_local_engine(command, {jobs, engine::usable_memory_bytes()},
                                     std::move(folder));
  }

  Result<> run_due() {
    if (request_.detach && request_.options.engine != BatchEngine::kSlurm)
      return fail(ErrorCode::kInvalidOption,
                  "--detach: with --engine local tasks end with this program; use --engine slurm");
    TURNSCAN_ASSIGN(const auto engine, make_engine());
    std::set<std::string> fresh;
    for (const auto& [name, due] : due_) fresh.insert(name);
    TURNSCAN_ASSIGN(const std::vector<std::string> adopted, engine->adopt());
    for (const std::string& name : adopted) fresh.erase(name);
    if (!fresh.empty()) TURNSCAN_TRY(engine->submit(jobs_for(fresh)));
    if (request_.detach) return {};
    return follow(*engine);
  }

  Result<> follow(engine::Engine& engine) {
    std::uint64_t steps = 0;
    for (const auto& [name, due] : due_) steps += steps_of(*due.task);
    context_.begin_phase("run tasks", steps);
    tell(engine);
    while (!due_.empty()) {
      auto ended = engine.poll();
      if (context_.cancelled()) {
        engine.cancel();
        return context_.check();
      }
      if (!ended) return tl::unexpected<Error>(std::move(ended).error());
      std::set<std::string> again;
      for (const engine::Ended& end : *ended) TURNSCAN_TRY(settle(end, again));
      if (!again.empty()) TURNSCAN_TRY(engine.submit(jobs_for(again)));
      tell(engine);
    }
    return {};
  }

  static std::uint64_t steps_of(const BatchTask& task) {
    return std::max<std::uint64_t>(task.frames, 1);
  }

  /// Reads the outcome of an ended task from its folder.
  Result<> settle(const engine::Ended& end, std::set<std::string>& again) {
    const auto found = due_.find(end.name);
    if (found == due_.end()) return {};  // adopted, and already done when the states were read
    Due& due = found->second;
    const TaskRecord record = folder_.record(end.name);
    const bool ran = record.attempts > due.attempts_before;
    const bool over =
        record.state == TaskState::kDone || (ran && record.state == TaskState::kFailed);
    if (!over && (end.lost || record.state == TaskState::kRunning) &&
        due.restarts < request_.options.restarts) {
      ++due.restarts;
      again.insert(end.name);
      return {};
    }
    if (!over) TURNSCAN_TRY(give_up(*due.task, end));
    ++(over && record.state == TaskState::kDone ? done_ : failed_);
    context_.advance(steps_of(*due.task));
    due_.erase(found);
    return {};
  }

  /// Uses the engine's reason, because the task's own process left none.
  Result<> give_up(const BatchTask& task, const engine::Ended& end) const {
    TaskRecord record = folder_.record(task.name);
    record.state = TaskState::kFailed;
    record.reason = end.reason.empty() ? "it ended without a result" : end.reason;
    auto prints = prints_of(task);
    record.inputs = prints ? std::move(*prints) : std::vector<InputPrint>();
    record.digest = digest_of(task, record.inputs);
    return folder_.save_record(task.name, record);
  }

  void tell(const engine::Engine& engine) const {
    if (!request_.on_status) return;
    std::string text = fmt::format("{} of {} done", outcome_.skipped + done_, tasks_.size());
    if (failed_ > 0) text += fmt::format(", {} failed", failed_);
    request_.on_status(text + "; " + engine.status());
  }

  const BatchRequest& request_;
  const RunContext& context_;
  const BatchFolder folder_;
  std::vector<BatchTask> tasks_;
  std::map<std::string, Due> due_;
  std::size_t done_ = 0, failed_ = 0;
  BatchOutcome outcome_;
};

}  // namespace

fs::path own_program() {
  std::error_code error;
  std::string path = fs::read_symlink("/proc/self/exe", error).string();
  // Suffix that the system reports for an executable that was replaced meanwhile; the new one is at
  // the same path.
  constexpr std::string_view kReplaced = " (deleted)";
  if (path.ends_with(kReplaced)) path.resize(path.size() - kReplaced.size());
  return path;
}

Result<> save_batch(const std::string& path, const std::vector<BatchTask>& tasks) {
  const BatchFolder folder(full_path(path));
  if (!folder.planned()) return folder.save_plan(tasks);
  TURNSCAN_ASSIGN(const file::FileLock lock, lock_batch(folder));
  return folder.save_plan(tasks);
}

Result<BatchOutcome> run_batch(const BatchRequest& request, const RunContext& context) {
  return BatchRunner(request, context).run();
}

}  // namespace turnscan
