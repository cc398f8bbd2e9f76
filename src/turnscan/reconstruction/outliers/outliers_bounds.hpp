#pragma once
// Lower bounds on how far the points of other columns and rows of a grid are: planes that hold them
// off, taken from the points themselves.

#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/outliers/outliers_kernel.hpp>
#include <vector>

namespace turnscan::outliers {

/// Coordinates in which columns and rows of a frame come apart. For rays from one point, w is the
/// depth from there along a middle direction, and u / w (v / w) grows with the column (row); for
/// others u (v) itself does: the linear function of space that says most about the column. A bound
/// is valid in any such coordinates; how far off it is depends on the choice.
struct BoundFrame {
  enum class Kind { kPinhole, kCentral, kLinear };
  Kind kind = Kind::kPinhole;  ///< kPinhole: u, v, w are x, y, z
  Vec3d origin = Vec3d::Zero();
  Vec3d u = Vec3d::UnitX(), v = Vec3d::UnitY(), w = Vec3d::UnitZ();  ///< central: u, v normal to w

  bool central() const { return kind != Kind::kLinear; }
};

/// kPinhole for depth images as they come, kLinear for parallel rays and where rays from the
/// viewpoint do not all go forward. Needs at least one point.
BoundFrame choose_bound_frame(const FramePoints& frame);

/// The smallest and the largest u / w (or u) of each column, for blocks of kBand rows; or of each
/// row, for blocks of columns. Infinite the wrong way round where there is no point.
class Extents {
 public:
  void reset(int lines, int across);
  void add(int line, int across, float value) {
    const std::size_t i = std::size_t(across / kBand) * std::size_t(lines_) + std::size_t(line);
    low_[i] = value < low_[i] ? value : low_[i];
    high_[i] = value > high_[i] ? value : high_[i];
  }
  int lines() const { return lines_; }
  int blocks() const { return blocks_; }
  /// The extents of all lines over the blocks [begin, end).
  void merge(int begin, int end, std::vector<float>& low, std::vector<float>& high) const;

 private:
  int lines_ = 0, blocks_ = 0;
  std::vector<float> low_, high_;
};

/// The planes before and beyond each line of the grid.
class BorderTables {
 public:
  /// One table, from all blocks. Returns how wide a line is on average, in steps from line to line.
  double build_whole(const Extents& extents, bool central);
  /// A table for each block, from it and its neighbours.
  void build_bands(const Extents& extents, bool central);
  Border before() const { return border(0); }
  Border beyond() const { return border(1); }

 private:
  void resize(int lines, int bands);
  void build(int band, bool central);
  Border border(int side) const;
  void fill(int band, int side, bool central);

  std::vector<float> values_, low_, high_;
  std::vector<double> planes_;
  int lines_ = 0, bands_ = 1;
  std::ptrdiff_t length_ = 0;
};

}  // namespace turnscan::outliers
