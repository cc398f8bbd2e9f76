#pragma once
// Tests plans with simulated scans and their reconstruction, in this process or by the engine of a
// batch.

#include <string>
#include <turnscan/workflow/plan/plan.hpp>
#include <vector>

namespace turnscan::workflow {

/// A scan to be simulated, reconstructed and evaluated.
struct TrialScene {
  std::string name;  ///< of its tasks; unique, and the same in later runs
  SceneDescription scene;
  const TriangleMesh* object = nullptr;  ///< as returned by read_object()
};

/// Returns one entry per scene. The failure of a scene is recorded in its trial. With a folder, the
/// scans and meshes become tasks of the batches trials/scans and trials/meshes there, after those
/// of earlier calls; finished tasks are not repeated. Fails as save_batch(), run_batch() and with
/// kCancelled.
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
