#pragma once
// Plans tried with simulated scans and their reconstruction: here, or by the engine of a batch.

#include <string>
#include <turnscan/workflow/plan/plan.hpp>
#include <vector>

namespace turnscan::workflow {

/// A scan that is to be simulated, reconstructed and judged.
struct TrialScene {
  std::string name;  ///< of its tasks; unique, and the same in a later run
  SceneDescription scene;
  const TriangleMesh* object = nullptr;  ///< of read_object()
};

/// One entry a scene. What fails of one scene stands in its trial. With a folder, the scans and
/// meshes are tasks of the batches trials/scans and trials/meshes there, after those of earlier
/// calls; what is done is not done again. Fails as save_batch(), run_batch() and with kCancelled.
class TrialRunner {
 public:
  TrialRunner(const PlanRequest& request) : request_(request) {}
  Result<std::vector<PlanTrial>> run(const std::vector<TrialScene>& scenes,
                                     const RunContext& context);

 private:
  Result<std::vector<PlanTrial>> run_here(const std::vector<TrialScene>& scenes,
                                          const RunContext& context) const;
  Result<std::vector<PlanTrial>> run_batches(const std::vector<TrialScene>& scenes,
                                             const RunContext& context);
  Result<> run_tasks(const std::string& folder, const std::vector<BatchTask>& tasks,
                     const RunContext& context) const;

  const PlanRequest& request_;
  std::vector<BatchTask> scans_, meshes_;
};

}  // namespace turnscan::workflow
