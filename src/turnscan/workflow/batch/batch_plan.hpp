#pragma once
// Plans the tasks of a batch.

#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <vector>

namespace turnscan {

struct BatchSource {
  /// One table (.csv, .toml); or recordings, folders that contain recordings, and batches whose
  /// results are recordings; for the command simulate, objects.
  std::vector<std::string> inputs;
  std::string command;             ///< empty: from the table, or reconstruct
  std::vector<std::string> set;    ///< NAME=VALUE, an option for every task
  std::vector<std::string> sweep;  ///< NAME=VALUE,VALUE,...: runs every task once with each value
};

/// One task for every recording and combination of swept values. Options of a task override those
/// of all tasks in the table, `set` overrides both, and a sweep overrides all. Paths in a table are
/// relative to its folder. Names come from the table or the paths, followed by the swept values.
/// Fails with kInvalidOption (naming the task or line: an unknown option, or two tasks of the same
/// name), with kNotFound if there is no recording, and as read_batch_table().
Result<std::vector<BatchTask>> plan_batch(const BatchSource& source);

}  // namespace turnscan
