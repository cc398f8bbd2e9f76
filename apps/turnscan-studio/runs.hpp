#pragma once
// What the Explorer has the library do. All of this runs on a worker's thread.

#include <optional>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/reconstruction/pipeline.hpp>

#include "loading.hpp"

namespace turnscan::studio {

/// The stage that ends with meshes; the others are those of saveable_stages().
inline const std::string kMeshStage = "mesh";

struct StageRun {
  NamedModels models;
  std::vector<Choice> choices;  ///< automatic values as they were used
};

/// Runs the pipeline on a recording or a cloud up to a stage. For a recording the results are those
/// of `turnscan reconstruct` with the same options (--calibration auto, --save-stage), byte for
/// byte. A mesh fails with kUnsupported, else as reconstruct() does.
Result<StageRun> run_stage_of(const Model& model, const std::string& stage,
                              const ReconstructOptions& options, const RunContext& context);

/// The statistical filter on a cloud.
Result<ModelDataPtr> filter_cloud(const Model& model, const OutlierOptions& options,
                                  const RunContext& context);

struct Comparison {
  ModelDataPtr colored;               ///< the compared model, coloured by distance
  std::vector<double> histogram;      ///< shares of the surface, from 0 to scale_m
  double scale_m = 0.0;               ///< distance of the last colour
  std::optional<Evaluation> figures;  ///< of a mesh
};

/// Distances of a mesh or cloud to a reference mesh. scale_m 0: the largest threshold. The colours
/// of a mesh are those of `turnscan evaluate --error-map`.
Result<Comparison> compare(const ModelData& compared, const ModelData& reference,
                           const EvaluateOptions& options, double scale_m,
                           const RunContext& context);

}  // namespace turnscan::studio
