#include <turnscan/workflow/batch/batch_status.hpp>

#include <algorithm>
#include <chrono>
#include <turnscan/io/file/file_lock.hpp>
#include <turnscan/workflow/batch/batch_summary.hpp>
#include <turnscan/workflow/text/text_table.hpp>

namespace turnscan {

using namespace batch;

namespace {

constexpr std::size_t kMaxLines = 50;  // of failures, and of running tasks

std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

/// Estimated from the time per frame so far, and the number of concurrent tasks.
std::string time_left(const BatchSummary& summary) {
  double seconds = 0.0, frames = 0.0, left = 0.0;
  for (const SummaryRow& row : summary.rows) {
    const double steps = static_cast<double>(std::max<std::uint64_t>(row.task->frames, 1));
    if (row.record.state == TaskState::kDone) {
      seconds += row.record.seconds;
      frames += steps;
    } else if (row.record.state != TaskState::kFailed) {
      left += steps;
    }
  }
  const std::size_t running = summary.count(TaskState::kRunning);
  if (frames == 0.0 || left == 0.0 || running == 0) return {};
  return fmt::format("About {} left with {} at once\n",
                     duration_text(left * seconds / frames / static_cast<double>(running)),
                     running);
}

void add_rows(const BatchSummary& summary, TaskState state, std::string& text) {
  workflow::TextTable table({0, 1});
  std::size_t count = 0;
  const double now =
      std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  for (const SummaryRow& row : summary.rows) {
    if (row.record.state != state || ++count > kMaxLines) continue;
    const bool failed = state == TaskState::kFailed;
    table.add({row.task->name,
               failed ? row.record.reason
                      : fmt::format("on {} for {}", row.record.host,
                                    duration_text(std::max(0.0, now - row.record.started_s)))});
  }
  if (count == 0) return;
  text += fmt::format("{}:\n{}", state == TaskState::kFailed ? "Failed" : "Running", table.text(2));
  if (count > kMaxLines) text += fmt::format("  and {} more; see summary.csv\n", count - kMaxLines);
}

}  // namespace

Result<std::string> batch_status_text(const std::string& path) {
  const BatchFolder folder(path);
  TURNSCAN_ASSIGN(const std::vector<BatchTask> tasks, folder.load_plan());
  const BatchSummary summary = summarize(folder, tasks);
  std::string text =
      fmt::format("{}: {} tasks, {} done, {} failed, {} running, {} waiting\n", path, tasks.size(),
                  summary.count(TaskState::kDone), summary.count(TaskState::kFailed),
                  summary.count(TaskState::kRunning), summary.count(TaskState::kWaiting));
  const auto open = folder.open();
  if (open && file::FileLock::held(*open, BatchFolder::kLock)) text += "A run goes on\n";
  text += time_left(summary);
  add_rows(summary, TaskState::kRunning, text);
  add_rows(summary, TaskState::kFailed, text);
  return text;
}

}  // namespace turnscan
