#pragma once
// Search for the k nearest neighbours in a grid or a tree of points: the inner loops, a kernel
// (core/simd/kernel_choice.hpp).

#include <cstddef>
#include <cstdint>
#include <turnscan/core/simd/kernel_choice.hpp>

namespace turnscan::outliers {

inline constexpr int kMaxLanes = 16;   ///< widest vector, in floats
inline constexpr int kPad = 8;         ///< empty cells around the grid: the widest ring of lanes
inline constexpr int kBand = 16;       ///< rows (columns) that share a table of their own, see Grid
inline constexpr int kMaxK = 128;      ///< most neighbours that the kernels look for
inline constexpr float kHole = 1e30f;  ///< z of an empty cell: its squared distance is infinite
/// A squared distance is rounded by at most 5 units of 2^-24, its bound by 2.
inline constexpr float kShrink = 1.0f - 0x1p-20f;

/// Planes that hold off columns (rows). Every point in column c or beyond it (before it) is at
/// least a[c] * w + b[c] * u + offset[c] away from the point with bound coordinates (u, w), with v
/// in place of u for rows; infinite where nothing lies there. Entries from -kPad - 1 to
/// columns + kPad + kMaxLanes can be read.
struct Border {
  const float *a, *b, *offset;
  std::ptrdiff_t band_stride;  ///< from the table of a band to the next one's
};

struct Borders {
  Border before_column, beyond_column, before_row, beyond_row;
};

/// One frame. A cell lies at row * stride + column; kPad cells before and behind each row and
/// column, and kMaxLanes more behind each row, are there and empty.
struct Grid {
  const float *x, *y, *z;  ///< points; z is kHole where there is none
  const float *u, *v, *w;  ///< bound coordinates of the points
  std::ptrdiff_t stride;
  int columns, rows;
  Borders whole;  ///< of all rows (columns)
  /// Where lines of the grid are bent: for the columns of the rows from one band before band i to
  /// one behind it (row / kBand = i), and for the rows of such columns.
  Borders bands;
  bool bent;
  /// Rounding of a bound: margin + margin_relative * (|x| + |y| + |z|).
  float margin, margin_relative;
};

inline constexpr int kLeaf = 16;      ///< points of a leaf, and boxes of a group
inline constexpr int kMaxLevels = 8;  ///< kLeaf to this power: more than 32 bits can number

/// Bounds of leaves or groups; low is kHole and high is -kHole behind the last, to a whole group.
struct Boxes {
  const float *low[3], *high[3];
};

/// Points without a grid, ordered by leaf, kHole behind the last. Level 0 bounds the leaves, each
/// further one groups of kLeaf boxes of the one below; the last has one group.
struct Tree {
  const float *x, *y, *z;
  std::size_t points;
  int levels;
  Boxes level[kMaxLevels];
};

struct OutlierKernel {
  /// Mean distance to the k nearest neighbours (k <= kMaxK) of each point of a row; there must be
  /// more than k points. Writes mean[column], and up to kMaxLanes - 1 values behind the last.
  /// Returns how many cells it looked at in windows of single points.
  std::uint64_t (*search_row)(const Grid& grid, int row, int k, float* mean);
  /// The same for the points of a leaf: mean[i] for point leaf * kLeaf + i, those behind the last
  /// point unspecified.
  void (*search_leaf)(const Tree& tree, std::size_t leaf, int k, float* mean);
};
using OutlierKernels = KernelChoice<OutlierKernel>;

}  // namespace turnscan::outliers
