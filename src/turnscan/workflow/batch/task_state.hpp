#pragma once
// State and outcome of a task.

#include <cstdint>
#include <optional>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/fingerprint.hpp>
#include <vector>

namespace turnscan::batch {

enum class TaskState {
  kWaiting,  ///< never run, stopped, killed, or changed since
  kRunning,
  kDone,
  kFailed
};

std::string name_of(TaskState state);

/// Content of state.json.
struct TaskRecord {
  TaskState state = TaskState::kWaiting;
  std::string digest;              ///< digest of the result's inputs; see digest_of()
  std::vector<InputPrint> inputs;  ///< as they were when they were read
  int attempts = 0;                ///< number of times it was started
  std::string host;                ///< on which it ran last
  double started_s = 0.0;          ///< start, seconds since 1970
  double seconds = 0.0;            ///< wall time from start to end
  double command_seconds = 0.0;    ///< wall time of the command alone
  double cpu_seconds = 0.0;        ///< processor time
  std::uint64_t peak_bytes = 0;    ///< peak memory
  int threads = 0;
  std::string reason;  ///< why it failed
};

std::string record_json(const TaskRecord& record);
/// Fails with kFormat.
Result<TaskRecord> record_of(const std::string& json);

}  // namespace turnscan::batch
