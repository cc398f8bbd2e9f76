#pragma once
// Stages of the pipeline run on a model. All of this runs on a worker's thread.

#include <string>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/workflow/passes/pass_pose.hpp>
#include <turnscan/workflow/progress/overall_progress.hpp>
#include <vector>

#include "explorer/loading.hpp"

namespace turnscan::studio {

/// The stage that ends with meshes; the others are those of saveable_stages().
inline const std::string kMeshStage = "mesh";

struct StageRun {
  NamedModels models;
  std::vector<ResolvedParameter> choices;  ///< automatic values as they were used
  QString not_joined;  ///< why passes are apart, each in a model of its own; else empty
};

/// Runs the pipeline on a recording or a cloud up to a stage. For a recording the results are those
/// of `turnscan reconstruct` with the same options (--calibration auto, --save-stage), byte for
/// byte: its passes are joined. A mesh fails with kUnsupported, else as reconstruct() does.
Result<StageRun> run_stage_of(const Model& model, const std::string& stage,
                              const ReconstructOptions& options, const RunContext& context);

/// What run_stage_of() comes to, where that is known: for the mesh of a recording.
PhasePlan stage_phases(const Model& model, const std::string& stage,
                       const ReconstructOptions& options);

/// The mesh of all passes of a recording, of which these lie where they are stated, as
/// `--pass-pose` and, where their `refine` says so, `--refine-pass-poses`. Fails as run_stage_of().
Result<StageRun> join_stated(const Model& recording, const std::vector<PassPose>& poses,
                             const ReconstructOptions& options, const RunContext& context);

/// A mesh of each pass, joined with no other, in the frame of its own table. Fails when no pass
/// gives one; not_joined names those that do not.
Result<StageRun> mesh_each_pass(const Model& recording, const ReconstructOptions& options,
                                const RunContext& context);

/// The statistical filter on a cloud.
Result<ModelDataPtr> filter_cloud(const Model& model, const OutlierOptions& options,
                                  const RunContext& context);

}  // namespace turnscan::studio
