#pragma once
// From measurements to meshes through candidate points (thesis 3.4): the stages of the methods
// poisson and concave-hull.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/voxels/measured_cells.hpp>

namespace turnscan::points {

/// Runs the stages threshold, objects, candidates, normals, refine, base, surface. spacing_m: 1 /
/// sqrt(points per square metre). out contains the results of the frames, with the thickness of the
/// cloud, and receives the objects. Fails as reconstruct() does.
Result<> reconstruct_points(const voxels::MeasuredCells& measurements, double spacing_m,
                            const std::optional<Cylinder>& cylinder,
                            const ReconstructOptions& options, const StageSink& sink,
                            const RunContext& context, Reconstruction& out);

}  // namespace turnscan::points
