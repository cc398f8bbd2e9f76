#pragma once
// Which tasks a batch consists of.

#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/workflow/batch/batch_task.hpp>
#include <vector>

namespace turnscan {

struct BatchSource {
  /// One table (.csv, .toml), or recordings, folders with recordings below them and batches whose
  /// results are recordings; of command simulate objects.
  std::vector<std::string> inputs;
  std::string command;             ///< empty: the table's, else reconstruct
  std::vector<std::string> set;    ///< NAME=VALUE, an option of every task
  std::vector<std::string> sweep;  ///< NAME=VALUE,VALUE,...: every task once with each
};

/// A task for every recording and combination of swept values. Options: a task's own take
/// precedence over those of all tasks in the table, `set` over both, a sweep over all. Paths in a
/// table are seen from its folder. Names come from the table or the paths, behind them the swept
/// values.
/// Fails with kInvalidOption (naming the task or line: an option that does not exist, two tasks of
/// one name), with kNotFound where there is no recording, and as read_batch_table().
Result<std::vector<BatchTask>> plan_batch(const BatchSource& source);

}  // namespace turnscan
