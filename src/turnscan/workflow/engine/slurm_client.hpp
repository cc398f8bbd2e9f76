#pragma once
// Wrapper of Slurm's command-line programs.

#include <map>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/workflow/engine/slurm_text.hpp>
#include <vector>

namespace turnscan::engine {

class SlurmClient {
 public:
  explicit SlurmClient(RunContext context) : context_(std::move(context)) {}

  /// Output of a program. Fails with kMissingData if it is not installed, with kLibrary and the
  /// program's message if it fails, with kCancelled.
  Result<std::string> call(const std::string& program, const std::vector<std::string>& arguments,
                           std::string_view input = {}) const;

  /// Elements of these jobs that squeue knows, including those that ended within some minutes
  /// (MinJobAge). Fails if the controller does not answer.
  Result<std::map<SlurmElement, SlurmState>> states(const std::vector<std::string>& jobs) const;
  /// States of elements that squeue no longer lists; empty if the cluster has no accounting.
  std::map<SlurmElement, SlurmState> accounted(const std::vector<std::string>& jobs) const;
  /// Numbers of this user's jobs with this name that have not ended.
  Result<std::vector<std::string>> live_jobs(const std::string& name) const;
  /// Maximum number of elements in one array.
  int largest_array() const;
  /// Memory of the largest node, as configured in Slurm; 1 if not configured.
  std::uint64_t node_megabytes() const;

 private:
  RunContext context_;
};

}  // namespace turnscan::engine
