#pragma once
// Spacing and noise estimated from the data, from which automatic parameters follow.

#include <turnscan/reconstruction/voxels/measured_cells.hpp>
#include <turnscan/reconstruction/voxels/merge.hpp>

namespace turnscan::estimation {

/// Statistics of single frames, before merging.
struct FrameStatistics {
  double spacing_m = 0.0;       ///< median distance between grid neighbours (or nearest neighbours)
  double even_spacing_m = 0.0;  ///< of a grid with as many points; the actual spacing if there is a
                                ///< grid
  double noise_m = 0.0;         ///< robust sigma of a point along its ray; 0 without a grid
};

/// Noise: second differences along the rows of the grid, z[i] - (z[i-1] + z[i+1]) / 2, have
/// variance 1.5 sigma^2 for independent noise and vanish on smooth surfaces; their median absolute
/// value gives sigma. Differences beside a step between two surfaces (mixed pixels, silhouettes)
/// are excluded as long as enough remain. Correlated noise is underestimated; merged_noise includes
/// it.
FrameStatistics frame_statistics(const FramePoints& points);

/// Statistics of the merged cloud.
struct CloudStatistics {
  double noise_m = 0.0;    ///< median thickness of the cloud along its normal (standard deviation)
  double spacing_m = 0.0;  ///< 1 / sqrt(points per square metre of surface)
};

/// Samples neighbourhoods of radius r, smallest first, until the thickness is below r / 4.5 (a
/// smaller ball would truncate the noise) and they contain a piece of surface rather than a single
/// profile of a line scanner. Thickness: the square root of the smallest eigenvalue of the
/// covariance. Deterministic. Starts at start_radius_m; ends at 16 times that.
CloudStatistics cloud_statistics(const voxels::MergedCloud& merged, double start_radius_m);

/// The same, using in each neighbourhood only points seen from about the same side, since both
/// faces of a thin wall together are thick. Needs the frame of each point, and the frames'
/// viewpoints. profiles: of line scanners; with other sensors a neighbourhood may be one line of
/// points, on a thin rod.
CloudStatistics one_sided_statistics(const voxels::MergedCloud& merged, double start_radius_m,
                                     bool profiles);

/// The same for measurements in cells. Clouds thinner than the cells may appear thinner than they
/// are.
CloudStatistics cloud_statistics(const voxels::MeasuredCells& measurements, double start_radius_m);

/// Distance between neighbouring frames where they are far apart: 95 % of the points have a nearer
/// point of another frame. For line scanners, whose profiles diverge with the distance from the
/// axis while the points on them stay close. 0 if there is only one frame. point_spacing_m: within
/// a frame; distances of more than 256 times that are not distinguished.
double frames_apart(const voxels::MergedCloud& merged, double point_spacing_m);

}  // namespace turnscan::estimation
