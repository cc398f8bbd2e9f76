#pragma once
// What the data say about themselves: spacing and noise, from which automatic values follow.

#include <turnscan/reconstruction/voxels/measured_cells.hpp>
#include <turnscan/reconstruction/voxels/merge.hpp>

namespace turnscan::estimation {

/// Of single frames, before merging.
struct FrameStatistics {
  double spacing_m = 0.0;       ///< median distance between grid neighbours (or nearest neighbours)
  double even_spacing_m = 0.0;  ///< of a grid with as many points; theirs where there is one
  double noise_m = 0.0;         ///< robust sigma of a point along its ray; 0 where there is no grid
};

/// Noise: second differences along the rows of the grid, z[i] - (z[i-1] + z[i+1]) / 2, have
/// 1.5 sigma^2 for independent noise and vanish on smooth surfaces; their median absolute value
/// gives sigma. Those beside a step between two surfaces (mixed pixels, silhouettes) are left out
/// as far as enough remain. Correlated noise is underestimated; merged_noise sees it.
FrameStatistics frame_statistics(const FramePoints& points);

/// Of the merged cloud.
struct CloudStatistics {
  double noise_m = 0.0;    ///< median thickness of the cloud along its normal (standard deviation)
  double spacing_m = 0.0;  ///< 1 / sqrt(points per square metre of surface)
};

/// Samples neighbourhoods of radius r, smallest first, until the thickness is below r / 4.5 (a
/// smaller ball would cut the noise off) and they hold a piece of surface, not one line of a line
/// scanner. Thickness: the square root of the smallest eigenvalue of the covariance. Deterministic.
/// Starts at start_radius_m; ends at 16 times that.
CloudStatistics cloud_statistics(const voxels::MergedCloud& merged, double start_radius_m);

/// The same, of each neighbourhood only what was seen from about the same side: both faces of a
/// thin wall together are thick. Needs the frame of each point, and the frames' viewpoints.
/// profiles: of line scanners; of others a neighbourhood may be one line of points, on a thin rod.
CloudStatistics one_sided_statistics(const voxels::MergedCloud& merged, double start_radius_m,
                                     bool profiles);

/// The same of measurements in cells. What is thinner than the cells may look thinner than it is.
CloudStatistics cloud_statistics(const voxels::MeasuredCells& measurements, double start_radius_m);

/// How far apart neighbouring frames lie where they lie far apart: of 95 % of the points the
/// nearest point of another frame is nearer. For line scanners, whose profiles part with the
/// distance from the axis while the points on them stay close. 0 when there is one frame only.
/// point_spacing_m: within a frame; distances of more than 256 times that are not distinguished.
double frames_apart(const voxels::MergedCloud& merged, double point_spacing_m);

}  // namespace turnscan::estimation
