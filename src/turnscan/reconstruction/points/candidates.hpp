#pragma once
// One candidate point (or, with ties, a few) per surviving voxel (thesis 3.4.3).

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/voxels/measured_cells.hpp>

namespace turnscan::points {

/// Candidate points of the grid's voxels, in the order of voxels.
struct Candidates {
  PointCloud cloud;                   ///< weights: points of the voxel; colours if there are any
  std::vector<Vec3f> towards_sensor;  ///< mean of the unit vectors to the sensors; not normalised
  std::vector<std::uint32_t> voxel;   ///< position in grid.voxels()
};

/// Candidates of each voxel of `grid`, which is measurements.grid or a filtered version of it.
/// Centroid: the mean of the voxel's points. Sub-voxel counting (figure 3.12): for each point, the
/// line through sensor and point is traversed across the point's voxel (exact traversal, Amanatides
/// and Woo 1987) and counted in each sub-voxel that it crosses; the centres of the sub-voxels with
/// the highest count are the candidates, all of them in case of a tie, each with its share of the
/// weight. kChord traverses the whole chord; kTowardsSensor only from the point towards the sensor,
/// which moves a noisy plane outwards. PointSums does the counting; measurements without peaks give
/// centroids.
Result<Candidates> find_candidates(const voxels::MeasuredCells& measurements,
                                   const voxels::VoxelGrid& grid, const RunContext& context);

}  // namespace turnscan::points
