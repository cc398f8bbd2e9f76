#pragma once
// Runs tasks as elements of Slurm's job arrays. The folder and the program must be reachable by the
// same path on all nodes.

#include <memory>
#include <turnscan/io/file/folder.hpp>
#include <turnscan/workflow/engine/engine.hpp>

namespace turnscan::engine {

struct SlurmSettings {
  std::string
      options;  ///< further options of sbatch, in shell syntax: "--partition=main --time=1:00"
  int tasks_per_job = 1;  ///< number of tasks that one array element runs in sequence
  double poll_s = 2.0;    ///< minimum interval between calls of squeue
};

/// Submits job arrays through sbatch and gets their states through squeue and sacct. Elements whose
/// node fails are queued again. Jobs outlive this object: the next one adopts them. Fails with
/// kInvalidOption if the options cannot be parsed, with kMissingData if there is no sbatch.
Result<std::unique_ptr<Engine>> make_slurm_engine(const JobCommand& command,
                                                  const SlurmSettings& settings,
                                                  file::Folder folder, const RunContext& context);

}  // namespace turnscan::engine
