#pragma once
// Sums the points of frames as they arrive, in cells that are fixed beforehand: memory does not
// grow with the number of points.

#include <memory>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options/point_options.hpp>
#include <turnscan/reconstruction/voxels/measured_cells.hpp>

namespace turnscan::voxels {

/// Points of one frame, table frame, and their viewpoint.
struct PointsSeen {
  std::span<const Vec3f> points;
  std::span<const Rgb> colors;  ///< empty, or as many as points
  Viewpoint viewpoint;
};

/// Per cell of half a voxel: number of points, their sum, the sum of the unit vectors to the
/// sensors, colour; and with sub-voxel counting (figure 3.12) the counts of the sub-voxels. Sums
/// are of integers (positions in 4096ths of a cell, directions in 2048ths), so that they depend
/// neither on the order of frames nor on their grouping nor on the number of threads.
class PointSums {
 public:
  /// voxel_m: edge in metres, > 0. origin_m: corner of a voxel, table frame.
  PointSums(double voxel_m, const CandidateOptions& options, const Vec3d& origin_m = Vec3d::Zero());
  PointSums(PointSums&&) noexcept;
  PointSums& operator=(PointSums&&) noexcept;
  ~PointSums();

  /// Adds frames, on all cores. Colours are kept as long as all frames have them. Fails with
  /// kInvalidOption, before anything is added, if a point is more than 2^21 cells from the origin.
  /// Points of a cell after the first million are counted, but no longer move its mean.
  Result<> add(std::span<const PointsSeen> frames);

  std::uint64_t points() const { return points_; }
  /// Number of bytes that the occupied cells take so far.
  std::size_t bytes() const;

  /// The measurements added so far; `joined` voxels along each side become one. Fails with
  /// kTooFewPoints if nothing was added, with kInvalidOption as VoxelGrid::build does, kCancelled.
  Result<MeasuredCells> collect(int joined, const RunContext& context) const;

  /// Centres of the sub-voxels that lines crossed; weights: how many. Empty unless they are
  /// counted.
  PointCloud sub_voxels() const;

 private:
  class Part;
  double voxel_m_;
  Vec3d origin_m_;
  CandidateOptions options_;
  bool colored_ = true;
  std::uint64_t points_ = 0;
  std::vector<std::unique_ptr<Part>> parts_;  ///< each holds the bricks that hash to it
};

}  // namespace turnscan::voxels
