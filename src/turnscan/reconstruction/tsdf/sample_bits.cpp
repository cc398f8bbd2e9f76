#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/sample_bits.hpp>

namespace turnscan::tsdf {

namespace {

constexpr std::size_t kGrain = 64;  // bricks
constexpr std::uint64_t kFirstOfRows = 0x0101010101010101u, kFirstRow = 0xffu;

}  // namespace

BrickBits spread_within(const BrickBits& r) {
  BrickBits out;
  for (std::size_t k = 0; k < kBrickSide; ++k) {
    out[k] = r[k] | r[k] << 8 | r[k] >> 8;
    out[k] |= (r[k] & ~(kFirstOfRows << 7)) << 1 | (r[k] & ~kFirstOfRows) >> 1;
    if (k > 0) out[k] |= r[k - 1];
    if (k + 1 < kBrickSide) out[k] |= r[k + 1];
  }
  return out;
}

BrickBits spread_from(const BrickBits& neighbour, int axis, int side) {
  BrickBits out{};
  if (axis == 2) {
    out[side > 0 ? kBrickSide - 1 : 0] = neighbour[side > 0 ? 0 : kBrickSide - 1];
    return out;
  }
  for (std::size_t k = 0; k < kBrickSide; ++k) {
    const std::uint64_t n = neighbour[k];
    if (axis == 0) out[k] = side > 0 ? (n & kFirstOfRows) << 7 : n >> 7 & kFirstOfRows;
    if (axis == 1) out[k] = side > 0 ? (n & kFirstRow) << 56 : n >> 56;
  }
  return out;
}

SampleBits SampleBits::grown(const SampleBits& within) const {
  SampleBits out(bricks_);
  parallel_for(bits_.size(), kGrain, [&](std::size_t b) {
    BrickBits bits = spread_within(bits_[b]);
    const GridCoords at = bricks_.coords(b);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        GridCoords next = at;
        next[std::size_t(axis)] += side;
        if (!bricks_.contains(next)) continue;
        const BrickBits from = spread_from(bits_[bricks_.at(next)], axis, side);
        for (std::size_t k = 0; k < kBrickSide; ++k) bits[k] |= from[k];
      }
    }
    for (std::size_t k = 0; k < kBrickSide; ++k) out.bits_[b][k] = bits[k] & within.bits_[b][k];
  });
  return out;
}

SampleBits SampleBits::minus(const SampleBits& other) const {
  SampleBits out(bricks_);
  for (std::size_t b = 0; b < bits_.size(); ++b)
    for (std::size_t k = 0; k < kBrickSide; ++k) out.bits_[b][k] = bits_[b][k] & ~other.bits_[b][k];
  return out;
}

SampleBits SampleBits::joined(const SampleBits& other) const {
  SampleBits out(bricks_);
  for (std::size_t b = 0; b < bits_.size(); ++b)
    for (std::size_t k = 0; k < kBrickSide; ++k) out.bits_[b][k] = bits_[b][k] | other.bits_[b][k];
  return out;
}

SampleBits unseen_samples(const Volume& volume) {
  SampleBits out(volume.bricks);
  parallel_for(volume.brick_count(), kGrain, [&](std::size_t b) {
    if (volume.slot[b] < 0) {
      if (volume.uniform[b] == 0.0f) out.brick(b).fill(kWholeLayer);
      return;
    }
    const float* weights = &volume.weight[volume.first_sample(b)];
    for (std::size_t c = 0; c < kBrickSamples; ++c)
      if (weights[c] <= 0.0f) insert(c, out.brick(b));
  });
  return out;
}

}  // namespace turnscan::tsdf
