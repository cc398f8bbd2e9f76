#pragma once
// Addresses in regular grids whose samples are stored in bricks of 8^3. The first coordinate always
// runs fastest.

#include <array>
#include <cstddef>

namespace turnscan {

/// Coordinates of a sample or of a brick along each axis.
using GridCoords = std::array<int, 3>;

inline constexpr int kBrickSide = 8;               ///< samples along an edge of a brick
inline constexpr std::size_t kBrickSamples = 512;  ///< of a whole brick
inline constexpr std::size_t kBrickLayer = 64;     ///< of a layer of one k

/// Position of a sample in its brick.
constexpr std::size_t sample_in_brick(int i, int j, int k) {
  return std::size_t((i & 7) | (j & 7) << 3 | (k & 7) << 6);
}

/// Linear indices of the cells of a box: bricks, groups of bricks, or samples of a dense grid.
/// Cells have coordinates from 0 on; at() requires cells inside the box.
class GridIndex {
 public:
  constexpr GridIndex() = default;
  constexpr explicit GridIndex(const GridCoords& size) : size_(size) {}

  /// Cells along each axis.
  constexpr const GridCoords& size() const { return size_; }
  constexpr std::size_t count() const {
    return std::size_t(size_[0]) * std::size_t(size_[1]) * std::size_t(size_[2]);
  }
  constexpr bool contains(const GridCoords& c) const {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < size_[0] && c[1] < size_[1] &&
           c[2] < size_[2];
  }
  constexpr std::size_t at(const GridCoords& c) const {
    return std::size_t(c[0]) +
           std::size_t(size_[0]) * (std::size_t(c[1]) + std::size_t(size_[1]) * std::size_t(c[2]));
  }
  constexpr GridCoords coords(std::size_t cell) const {
    const auto nx = std::size_t(size_[0]), ny = std::size_t(size_[1]);
    return {int(cell % nx), int(cell / nx % ny), int(cell / nx / ny)};
  }

 private:
  GridCoords size_{};
};

}  // namespace turnscan
