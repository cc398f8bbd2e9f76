#pragma once
// A set of a volume's samples: one bit each, brick by brick.

#include <array>
#include <cstdint>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

/// One layer per word, i fastest.
using BrickBits = std::array<std::uint64_t, kBrickSide>;

inline bool contains(const BrickBits& brick, std::size_t sample) {
  return (brick[sample >> 6] >> (sample & 63) & 1) != 0;
}
inline void insert(std::size_t sample, BrickBits& brick) {
  brick[sample >> 6] |= std::uint64_t(1) << (sample & 63);
}
inline constexpr std::uint64_t kWholeLayer = ~std::uint64_t(0);

class SampleBits {
 public:
  explicit SampleBits(const GridIndex& bricks) : bits_(bricks.count()) {}

  BrickBits& brick(std::size_t b) { return bits_[b]; }
  const BrickBits& brick(std::size_t b) const { return bits_[b]; }

 private:
  std::vector<BrickBits> bits_;
};

/// The samples that no view observed, including those of bricks without samples that are unknown.
SampleBits unseen_samples(const Volume& volume);

}  // namespace turnscan::tsdf
