#pragma once
// Point clouds as cubes, which a picture can shade: voxels and sub-voxels with their counts, and
// points.

#include <string>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// A cube for each point whose weight is at least min_weight (without weights: for each), in the
/// point's colour, else from violet to yellow by its weight, up to the largest but for 5 % of all
/// points. Where the points lie on a grid along the axes, as the stages voxels and sub-voxels do,
/// cubes are its cells, and faces between two of them are left out; otherwise a cube is 0.6 of the
/// median distance to the fourth neighbour. Fails with kTooFewPoints if no cube is left, and with
/// kCancelled.
Result<TriangleMesh> cubes_of(const PointCloud& cloud, double min_weight,
                              const RunContext& context);

/// A mesh to show, or the cubes of a cloud (.pcd, or .ply without triangles). Fails as read_mesh(),
/// read_cloud() and cubes_of() do.
Result<TriangleMesh> read_shown(const std::string& path, double min_weight,
                                const RunContext& context);

}  // namespace turnscan
