#pragma once
// Tasks as elements of Slurm's job arrays. The folder must lie where all nodes see it by the same
// path, and so must the program.

#include <memory>
#include <turnscan/workflow/engine/engine.hpp>

namespace turnscan::engine {

struct SlurmSettings {
  std::string
      options;  ///< further options of sbatch, as in a shell: "--partition=main --time=1:00"
  int tasks_per_job = 1;  ///< one element of an array runs so many, one after the other
  double poll_s = 2.0;    ///< squeue is asked at most that often
};

/// Job arrays through sbatch, states through squeue and sacct. Elements whose node fails go back
/// into the queue. Jobs go on without this object: the next one adopts them. Fails with
/// kInvalidOption when the options cannot be read, with kMissingData where there is no sbatch.
Result<std::unique_ptr<Engine>> make_slurm_engine(const JobCommand& command,
                                                  const SlurmSettings& settings,
                                                  const std::filesystem::path& folder,
                                                  const RunContext& context);

}  // namespace turnscan::engine
