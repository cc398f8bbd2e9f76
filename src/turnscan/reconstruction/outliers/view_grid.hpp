#pragma once
// Exact nearest neighbours among the points of one view.

#include <optional>
#include <span>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan::outliers {

/// Points in front of the origin (metres, +z forward), sorted into cells of the plane z = 1. Where
/// they cover it evenly, as those of a depth image do, a search is several times as fast as in a
/// tree.
class ViewGrid {
 public:
  /// nullopt if a point is not in front of the origin, or if many share a cell: a tree is better.
  static std::optional<ViewGrid> build(std::span<const Vec3f> points);

  /// The squared distances from one of the points to the k nearest, ascending, itself included: the
  /// values that KdTree::knn() gives. Returns their number: min(k, number of points).
  std::size_t nearest(const Vec3f& p, std::size_t k, float* squared) const;

 private:
  /// A line between cells and the origin span a plane.
  struct Line {
    double at, per_length;  ///< its coordinate, and 1 over the length of the plane's normal
  };
  /// The cells along one axis.
  struct Axis {
    double first = 0.0;
    std::vector<Line> lines;

    void divide(double low, double high, double cell);
    int cells() const { return int(lines.size()) - 1; }
    int cell_of(double at, double per_cell) const;
    /// Lower bound of the distance from a point to those outside the cells about its own; infinity
    /// if there are none.
    double clearance(double sideways, double z, int cell, int reach) const;
  };
  struct Search;

  std::size_t cell_begin(int row, int column) const {
    return begin_[std::size_t(row) * std::size_t(columns_.cells()) + std::size_t(column)];
  }

  double per_cell_ = 0.0;
  Axis columns_, rows_;
  std::vector<std::uint32_t> begin_;  // of each cell among the points; one more at the end
  std::vector<Vec3f> points_;         // cell by cell
};

}  // namespace turnscan::outliers
