#pragma once
// Distance of a model from another one. Runs on a worker thread.

#include <optional>
#include <turnscan/evaluation/evaluate.hpp>
#include <vector>

#include "explorer/models.hpp"

namespace turnscan::studio {

struct Comparison {
  ModelDataPtr colored;               ///< the compared model, coloured by distance
  std::vector<double> histogram;      ///< shares of the surface, for distances from 0 to scale_m
  double scale_m = 0.0;               ///< distance of the last colour
  std::optional<Evaluation> figures;  ///< for a mesh
};

/// Computes distances of a mesh or cloud to a reference mesh. scale_m 0: the largest threshold. The
/// colours of a mesh are those of `turnscan evaluate --error-map`.
Result<Comparison> compare(const ModelData& compared, const ModelData& reference,
                           const EvaluateOptions& options, double scale_m,
                           const RunContext& context);

}  // namespace turnscan::studio
