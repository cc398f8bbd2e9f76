#pragma once

#include <turnscan/workflow/batch/batch_task.hpp>

namespace turnscan::batch {

/// Sets frames and peak_bytes of a task. An input that cannot be opened counts as zero: the task
/// will fail and report why.
void measure_task(BatchTask& task);

}  // namespace turnscan::batch
