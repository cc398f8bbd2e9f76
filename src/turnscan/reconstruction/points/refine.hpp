#pragma once
// Moves candidates onto the local surface of the measurements around them.

#include <turnscan/reconstruction/points/candidates.hpp>

namespace turnscan::points {

struct RefineScale {
  double radius_m;  ///< standard deviation of the tangential weight
  double noise_m;   ///< standard deviation of the measurements along the normal
};

/// Moving least squares projection (Levin 2003) with a robust weight (Tukey): a height field of
/// degree 2 is fitted to the measurements within a cylinder along each candidate's normal that were
/// seen from its side (cells, by their means and weighted by their counts), and the candidate moves
/// onto it; the normal follows. Candidates with too little support are dropped. Then one candidate
/// per cell of max(voxel, 0.6 radius_m) is kept: those that fall into one cell with similar normals
/// are averaged. Needs normals; candidates.voxel remains the voxel they came from.
Result<Candidates> refine_candidates(const voxels::MeasuredCells& measurements,
                                     const voxels::VoxelGrid& grid, const Candidates& candidates,
                                     const RefineScale& scale, int iterations,
                                     const RunContext& context);

}  // namespace turnscan::points
