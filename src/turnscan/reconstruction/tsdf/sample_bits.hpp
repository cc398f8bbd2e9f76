#pragma once
// A set of a volume's samples: a bit each, brick by brick.

#include <array>
#include <cstdint>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// A layer in each word, i fastest.
using BrickBits = std::array<std::uint64_t, kBrickSide>;

/// Of a brick the samples in the set and those beside them along the axes, in the same brick.
BrickBits spread_within(const BrickBits& brick);
/// What samples of the brick beside this one, along an axis and on a side (-1 or 1), touch.
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

  /// With the samples beside them along the axes, those of `within` only.
  SampleBits grown(const SampleBits& within) const;
  SampleBits minus(const SampleBits& other) const;
  SampleBits joined(const SampleBits& other) const;

 private:
  GridIndex bricks_;
  std::vector<BrickBits> bits_;
};

/// The samples that no view saw, with those of bricks without samples of which nothing is known.
SampleBits unseen_samples(const Volume& volume);

}  // namespace turnscan::tsdf
