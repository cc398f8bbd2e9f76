#pragma once
// Search for neighbours in the grid of a frame.

#include <span>
#include <turnscan/reconstruction/outliers/outliers_bounds.hpp>

namespace turnscan::outliers {

/// A frame's points laid out by cell, cut to the box of cells that are taken. Keeps its memory for
/// the next frame.
class PointGrid {
 public:
  /// False when the frame must be searched in another way: two points share a
  /// cell, or the points are lost in a grid far too large for them. Throws
  /// std::invalid_argument when a cell is outside the frame's grid.
  bool build(const FramePoints& frame);

  const Grid& grid() const { return grid_; }
  /// Position of each point in the grid's arrays (of mean distances too).
  const std::vector<std::int32_t>& position() const { return position_; }
  std::size_t array_size() const { return z_.size(); }

 private:
  bool find_box(const FramePoints& frame);
  void lay_out(const FramePoints& frame);
  bool place(const FramePoints& frame);
  void place_bound_coordinates(const FramePoints& frame);
  void build_borders(bool central);
  void move_origin();

  int first_column_ = 0, first_row_ = 0;
  BoundFrame bounds_;
  std::vector<float> x_, y_, z_, u_, v_, w_;
  std::vector<std::int32_t> position_;
  Extents columns_, rows_;
  BorderTables column_table_, row_table_, column_bands_, row_bands_;
  Grid grid_{};
};

/// Mean distances to the k nearest neighbours, one per point, in frame order; needs more than k
/// points. False when the grid is of no use (k > kMaxK, see PointGrid::build, or when most points
/// need windows so wide that a tree is faster); mean is then undefined.
bool grid_mean_distances(const FramePoints& frame, int k, std::span<float> mean);

}  // namespace turnscan::outliers
