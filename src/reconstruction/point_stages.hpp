#pragma once
// From the merged cloud to meshes through candidate points (thesis 3.4): the stages of the methods
// poisson and concave-hull.

#include <turnscan/reconstruction/pipeline.hpp>

namespace turnscan {

/// Voxels, candidates, normals, refine, base, surface. out holds what the frames told, and gets the
/// objects. profiles: frames are lines of points without neighbours across. Fails as reconstruct()
/// does.
Result<> reconstruct_points(MergedCloud merged, bool profiles,
                            const std::optional<Cylinder>& cylinder,
                            const ReconstructOptions& options, const StageSink& sink,
                            const RunContext& context, Reconstruction& out);

}  // namespace turnscan
