#pragma once
// Points of frames added up as they come, in cells that are fixed to the table frame: what is kept
// does not grow with the number of points.

#include <memory>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options/point_options.hpp>
#include <turnscan/reconstruction/voxels/measured_cells.hpp>

namespace turnscan::voxels {

/// Points of one frame, table frame, and where they were seen from.
struct PointsSeen {
  std::span<const Vec3f> points;
  std::span<const Rgb> colors;  ///< empty, or as many as points
  Viewpoint viewpoint;
};

/// Per cell of half a voxel: number of points, their sum, that of the unit vectors to the sensors,
/// colour; and with sub-voxel counting (figure 3.12) the counts of the sub-voxels. Sums are of
/// integers (places in 4096ths of a cell, directions in 2048ths), so that they depend neither on
/// the order of frames nor on how they are handed over nor on the number of threads.
class PointSums {
 public:
  /// Voxel edge in metres, > 0.
  PointSums(double voxel_m, const CandidateOptions& options);
  PointSums(PointSums&&) noexcept;
  PointSums& operator=(PointSums&&) noexcept;
  ~PointSums();

  /// Adds frames, on all cores. Colours are kept as long as all frames have them. Fails with
  /// kInvalidOption, before anything is added, when a point lies more than 2^21 cells from the
  /// origin. Of a cell's points those after the first million count, but no longer move its mean.
  Result<> add(std::span<const PointsSeen> frames);

  std::uint64_t points() const { return points_; }
  /// Occupied cells so far, and bytes that they take.
  std::size_t bytes() const;

  /// What was added; `joined` voxels along each side become one. Fails with kTooFewPoints when
  /// nothing was added, kInvalidOption as VoxelGrid::build does, kCancelled.
  Result<MeasuredCells> collect(int joined, const RunContext& context) const;

 private:
  class Part;
  double voxel_m_;
  CandidateOptions options_;
  bool colored_ = true;
  std::uint64_t points_ = 0;
  std::vector<std::unique_ptr<Part>> parts_;  ///< each holds the bricks that hash to it
};

}  // namespace turnscan::voxels
