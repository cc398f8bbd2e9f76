#pragma once
// A set of a volume's samples: one bit each, brick by brick.

#include <array>
#include <cstdint>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// One layer per word, i fastest.
using BrickBits = std::array<std::uint64_t, kBrickSide>;

/// The samples of a brick in the set and their neighbours along the axes, in the same brick.
BrickBits spread_within(const BrickBits& brick);
/// The samples that those of the adjacent brick, along an axis and on a side (-1 or 1), touch.
BrickBits spread_from(const BrickBits& neighbour, int axis, int side);

inline bool contains(const BrickBits& brick, std::size_t sample) {
  return (brick[sample >> 6] >> (sample & 63) & 1) != 0;
}
inline void insert(std::size_t sample, BrickBits& brick) {
  brick[sample >> 6] |= std::uint64_t(1) << (sample & 63);
}
inline constexpr std::uint64_t kWholeLayer = ~std::uint64_t(0);

class SampleBits {
 public:
  explicit SampleBits(const GridIndex& bricks) : bricks_(bricks), bits_(bricks.count()) {}

  BrickBits& brick(std::size_t b) { return bits_[b]; }
  const BrickBits& brick(std::size_t b) const { return bits_[b]; }

  /// The set with its neighbours along the axes, restricted to `within`.
  SampleBits grown(const SampleBits& within) const;
  SampleBits minus(const SampleBits& other) const;
  SampleBits joined(const SampleBits& other) const;

 private:
  GridIndex bricks_;
  std::vector<BrickBits> bits_;
};

/// The samples that no view observed, including those of bricks without samples that are unknown.
SampleBits unseen_samples(const Volume& volume);

}  // namespace turnscan::tsdf
