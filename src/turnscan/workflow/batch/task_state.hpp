#pragma once
// What has become of a task.

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

/// What state.json holds.
struct TaskRecord {
  TaskState state = TaskState::kWaiting;
  std::string digest;              ///< what the result was made of; see digest_of()
  std::vector<InputPrint> inputs;  ///< as they were read
  int attempts = 0;                ///< how often it was begun
  std::string host;                ///< where it ran last
  double started_s = 0.0;          ///< seconds since 1970
  double seconds = 0.0;            ///< from its beginning to its end
  double command_seconds = 0.0;    ///< of that the command itself
  double cpu_seconds = 0.0;        ///< processor time
  std::uint64_t peak_bytes = 0;    ///< of memory
  int threads = 0;
  std::string reason;  ///< why it failed
};

std::string record_json(const TaskRecord& record);
/// Fails with kFormat.
Result<TaskRecord> record_of(const std::string& json);

}  // namespace turnscan::batch
