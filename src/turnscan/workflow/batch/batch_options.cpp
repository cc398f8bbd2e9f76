#include <turnscan/workflow/batch/batch_run.hpp>

namespace turnscan {

OptionTable describe(BatchRunOptions& o) {
  OptionTable table;
  table
      .choice("engine", o.engine, {"local", "slurm"},
              "What runs the tasks: this machine, or a cluster's Slurm by sbatch")
      .text("engine-options", o.engine_options,
            "slurm: further options of sbatch, e.g. \"--partition=long --time=2:00:00\"")
      .number("jobs", o.jobs, {1, 4096},
              "local: how many tasks run at once; auto: as many as cores and memory allow, by an "
              "estimate from the frames")
      .number("task-threads", o.task_threads, {1, 1024},
              "Threads of each task; auto: 1, or more where there are fewer tasks than cores")
      .number("tasks-per-job", o.tasks_per_job, {1, 100000},
              "slurm: how many tasks one element of a job array runs, one after the other")
      .number("restarts", o.restarts, {0, 100},
              "How often a task is restarted whose process or node was lost");
  return table;
}

}  // namespace turnscan
