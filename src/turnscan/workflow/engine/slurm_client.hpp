#pragma once
// Calls of Slurm's programs.

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

  /// Output of a program. Fails with kMissingData where it is not installed, with kLibrary and its
  /// own words when it fails, with kCancelled.
  Result<std::string> call(const std::string& program, const std::vector<std::string>& arguments,
                           std::string_view input = {}) const;

  /// Elements of these jobs that squeue knows, ended ones for some minutes (MinJobAge), too. Fails
  /// when the controller does not answer.
  Result<std::map<SlurmElement, SlurmState>> states(const std::vector<std::string>& jobs) const;
  /// Of elements that squeue has forgotten; none where the cluster keeps no accounts.
  std::map<SlurmElement, SlurmState> accounted(const std::vector<std::string>& jobs) const;
  /// Numbers of the jobs of this user with this name that have not ended.
  Result<std::vector<std::string>> live_jobs(const std::string& name) const;
  /// Elements that one array may have.
  int largest_array() const;
  /// Of the largest node, as far as Slurm was told; 1 where it was not.
  std::uint64_t node_megabytes() const;

 private:
  RunContext context_;
};

}  // namespace turnscan::engine
