#pragma once
// Lower bounds on how far the points of other columns and rows of a grid are: planes that hold them
// off, taken from the points themselves. Internal to the outlier filter; not installed.

#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/outliers_kernel.hpp>
#include <vector>

namespace turnscan::outliers {

/// Coordinates in which columns and rows of a frame come apart. For rays from one point, w is the
/// depth from there along a middle direction, and u / w (v / w) grows or falls with the column
/// (row); for others u (v) itself does: the linear function of space that says most about the
/// column. A bound is valid in any such coordinates; how far off it is depends on the choice.
struct BoundFrame {
  enum class Kind { kPinhole, kCentral, kLinear };
  Kind kind = Kind::kPinhole;  ///< kPinhole: u, v, w are x, y, z
  Vec3d origin = Vec3d::Zero();
  Vec3d u = Vec3d::UnitX(), v = Vec3d::UnitY(), w = Vec3d::UnitZ();  ///< central: u, v normal to w

  bool central() const { return kind != Kind::kLinear; }
};

/// kLinear for parallel rays, and where rays from the viewpoint do not all go forward.
BoundFrame choose_bound_frame(const FramePoints& frame);

/// The smallest and the largest u / w (or u) in each column.
struct Extent {
  std::vector<float> low, high;

  void reset(int count);
  void add(int i, float value) {
    low[i] = value < low[i] ? value : low[i];
    high[i] = value > high[i] ? value : high[i];
  }
};

/// The planes before and beyond each column.
class BorderTables {
 public:
  void build(const Extent& extent, bool central);
  Border before() const { return border(0); }
  Border beyond() const { return border(1); }

 private:
  Border border(int side) const;
  void set(int side, int i, double plane, bool central);

  std::vector<float> values_;
  int count_ = 0, length_ = 0;
};

}  // namespace turnscan::outliers
