#pragma once
// Runs stages of the pipeline on a model. All of this runs on a worker thread.

#include <string>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/passes/pass_pose.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <vector>

#include "explorer/loading.hpp"

namespace turnscan::studio {

/// The final stage, which makes meshes; the others are those of saveable_stages().
inline const std::string kMeshStage = "mesh";

struct StageRun {
  NamedModels models;
  MadeWithPtr made;                        ///< lists these values, too
  std::vector<ResolvedParameter> choices;  ///< values used for automatic options
  QString not_joined;  ///< why passes are separate, each in its own model; else empty
};

/// Runs the pipeline on a recording or a cloud up to a stage. For a recording the results are those
/// of `turnscan reconstruct` with the same options (--calibration auto, --save-stage), byte for
/// byte, including joined passes. Fails with kUnsupported for a mesh, else as reconstruct() does.
Result<StageRun> run_stage_of(const Model& model, const std::string& stage,
                              const ReconstructOptions& options, const RunContext& context);

/// Phases of run_stage_of(), if known: for the mesh of a recording.
PhasePlan stage_phases(const Model& model, const std::string& stage,
                       const ReconstructOptions& options);

/// The mesh of all passes of a recording with these stated poses, as with `--pass-pose` and, for
/// those with `refine`, `--refine-pass-poses`. Fails as run_stage_of().
Result<StageRun> join_stated(const Model& recording, const std::vector<PassPose>& poses,
                             const ReconstructOptions& options, const RunContext& context);

/// A separate mesh of each pass, in the frame of its own table. Fails if no pass gives one;
/// not_joined names those that do not.
Result<StageRun> mesh_each_pass(const Model& recording, const ReconstructOptions& options,
                                const RunContext& context);

/// Applies the statistical filter to a cloud.
Result<ModelDataPtr> filter_cloud(const Model& model, const OutlierOptions& options,
                                  const RunContext& context);

}  // namespace turnscan::studio
