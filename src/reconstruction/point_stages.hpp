#pragma once
// From measurements to meshes through candidate points (thesis 3.4): the stages of the methods
// poisson and concave-hull.

#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

/// Threshold, objects, candidates, normals, refine, base, surface. spacing_m: 1 / sqrt(points per
/// square metre). out holds what the frames told, with the thickness of the cloud, and gets the
/// objects. Fails as reconstruct() does.
Result<> reconstruct_points(const Measurements& measurements, double spacing_m,
                            const std::optional<Cylinder>& cylinder,
                            const ReconstructOptions& options, const StageSink& sink,
                            const RunContext& context, Reconstruction& out);

}  // namespace turnscan
