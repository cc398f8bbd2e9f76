#pragma once
// One level of the octree of the Poisson solver: the cells of a regular grid over a cube, kept in
// bricks of 8^3 near the surface. Each cell has the coefficient of the quadratic B-spline around
// its centre.

#include <algorithm>
#include <array>
#include <cstdint>
#include <turnscan/geometry/grid/grid_index.hpp>
#include <vector>

namespace turnscan::poisson {

using Index = GridCoords;
/// One coefficient per cell, brick after brick, x fastest within a brick.
using Field = std::vector<float>;

inline constexpr int kSide = kBrickSide;
inline constexpr std::size_t kCells = kBrickSamples;
/// A brick with two layers of cells around it, the support of the B-splines.
inline constexpr int kHalo = 2, kWide = kSide + 2 * kHalo;
using Block = std::array<float, std::size_t(kWide* kWide* kWide)>;
constexpr std::size_t in_block(int i, int j, int k) {
  return std::size_t(i + kHalo + kWide * (j + kHalo + kWide * (k + kHalo)));
}
constexpr std::size_t in_brick(int i, int j, int k) { return sample_in_brick(i, j, k); }

/// The slots of a brick and its 26 neighbours, by (di + 1) + 3 (dj + 1) + 9 (dk + 1).
using Neighbours = std::array<std::int32_t, 27>;

/// Colour of a brick. Bricks of one colour never touch a common cell when each changes its own
/// cells and those beside them.
inline std::size_t color_of(const Index& b) {
  return std::size_t((b[0] & 1) | (b[1] & 1) << 1 | (b[2] & 1) << 2);
}

/// The set of existing bricks of a level.
class SparseBricks {
 public:
  /// depth >= 3: 2^depth cells along each axis.
  explicit SparseBricks(int depth);

  int depth() const { return depth_; }
  int cells() const { return 1 << depth_; }
  /// Bricks along each axis, whether they exist or not.
  int side() const { return grid_.size()[0]; }
  std::size_t size() const { return bricks_.size(); }
  const Index& operator[](std::size_t slot) const { return bricks_[slot]; }

  bool contains(const Index& b) const { return grid_.contains(b); }
  /// Index of a brick in the order of adding, -1 if it does not exist.
  std::int32_t slot(const Index& b) const { return contains(b) ? slot_[grid_.at(b)] : -1; }
  /// Does nothing for a brick beyond the cube or one that exists.
  void add(const Index& b);
  Neighbours neighbours(const Index& b) const;
  /// Position of a cell in a field, -1 if its brick does not exist.
  std::ptrdiff_t cell(int i, int j, int k) const {
    const std::int32_t s = slot({i >> 3, j >> 3, k >> 3});
    return s < 0 ? -1 : std::ptrdiff_t(std::size_t(s) * kCells + in_brick(i, j, k));
  }
  /// The coefficients of a brick and around it. 0 where the field, which may end before the last
  /// bricks, has none; beyond the cube's faces the negative of the mirrored coefficient, so that
  /// functions are 0 on the faces.
  void gather(const Field& field, std::size_t slot, Block& out) const;

  /// out[wide^3] = the coefficients of the cells from `first` on, x fastest. Where the field has
  /// none, also beyond the cube: missing(i, j, k).
  template <class Missing>
  void window(const Field& field, const Index& first, int wide, const Missing& missing,
              float* out) const;

 private:
  int depth_;
  GridIndex grid_;
  std::vector<std::int32_t> slot_;
  std::vector<Index> bricks_;
};

template <class Missing>
void SparseBricks::window(const Field& field, const Index& first, int wide, const Missing& missing,
                          float* out) const {
  for (int k = first[2]; k < first[2] + wide; ++k) {
    for (int j = first[1]; j < first[1] + wide; ++j) {
      for (int i = first[0]; i < first[0] + wide;) {
        const int end = std::min((i & ~(kSide - 1)) + kSide, first[0] + wide);
        const std::ptrdiff_t at = cell(i, j, k);
        if (at >= 0 && std::size_t(at) < field.size()) {
          out = std::copy_n(&field[std::size_t(at)], end - i, out);
          i = end;
        } else {
          for (; i < end; ++i) *out++ = missing(i, j, k);
        }
      }
    }
  }
}

}  // namespace turnscan::poisson
