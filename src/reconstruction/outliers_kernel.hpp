#pragma once
// Search for the k nearest neighbours in a grid of points: the inner loops, on plain arrays, built
// once per instruction set. Internal to the outlier filter; not installed.
// The sources that include this are compiled for other instruction sets: nothing here may bring
// in inline functions that the linker could merge with those of other sources.

#include <cstddef>
#include <cstdint>

namespace turnscan::outliers {

inline constexpr int kMaxLanes = 16;   ///< widest vector, in floats
inline constexpr int kPad = 8;         ///< empty cells around the grid: the widest ring of lanes
inline constexpr int kMaxLaneK = 64;   ///< larger k are searched point by point
inline constexpr float kHole = 1e30f;  ///< z of an empty cell: its squared distance is infinite
/// A squared distance may be rounded by 5 units of 2^-24, its bound by 3.
inline constexpr float kShrink = 1.0f - 0x1p-20f;

/// Planes that hold off whole columns or rows. Every point in column c or beyond it (before it) is
/// at least a[c] * w + b[c] * u + offset[c] away from the point with bound coordinates (u, w), with
/// v in place of u for rows; infinite where nothing lies beyond. Entries from -kPad - 1 to
/// columns + kPad + kMaxLanes can be read.
struct Border {
  const float* a;
  const float* b;
  const float* offset;
};

/// One frame. A cell lies at row * stride + column; kPad cells before and behind each row and
/// column, and kMaxLanes more behind each row, are there and empty.
struct Grid {
  const float *x, *y, *z;  ///< points; z is kHole where there is none
  const float *u, *v, *w;  ///< bound coordinates of the points
  std::ptrdiff_t stride;
  int columns, rows;
  Border before_column, beyond_column, before_row, beyond_row;
  /// Rounding of a bound: margin + margin_relative * (|x| + |y| + |z|).
  float margin, margin_relative;
};

struct Unsettled {
  std::int32_t column, row;
  float squared_distance;  ///< k points are at most as far; may be infinite
};

struct Kernel {
  /// Mean distance to the k nearest neighbours (k <= kMaxLaneK) of the points of a row, where a
  /// ring of at most kPad cells proves it. Writes mean[column] (up to kMaxLanes - 1 more), and
  /// those that need a wider window to unsettled (room for columns). Returns how many these are.
  std::size_t (*search_row)(const Grid& grid, int row, int k, float* mean, Unsettled* unsettled);
  /// Appends the squared distances from point i (a cell's position in the arrays) to the points of
  /// n cells from `first` that are <= limit to out (room for n + kMaxLanes). Returns how many.
  std::size_t (*collect)(const Grid& grid, std::ptrdiff_t i, std::ptrdiff_t first, int n,
                         float limit, float* out);
};

enum class InstructionSet { kPortable, kAvx2, kAvx512 };

/// nullptr when it was not built or this machine lacks it.
const Kernel* kernel_for(InstructionSet set);
/// The widest that this machine has, or the one set by use_instruction_set.
const Kernel& kernel();
/// For tests and benchmarks: all later calls use this one. Throws std::invalid_argument when
/// kernel_for has none.
void use_instruction_set(InstructionSet set);

}  // namespace turnscan::outliers
