#pragma once
// What can be reached from beyond a volume. Internal.

#include <cstdint>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/volume_samples.hpp>

namespace turnscan::detail {

/// Which samples that are not inside can be reached, from one to the next, from beyond the volume:
/// a bit each, brick by brick.
class Flood {
 public:
  explicit Flood(const Volume& volume)
      : v_(volume), open_(volume.brick_count()), reached_(volume.brick_count()) {
    parallel_for(v_.brick_count(), 64, [&](std::size_t b) {
      const std::int32_t slot = v_.slot[b];
      for (std::size_t k = 0; k < kSide; ++k) {
        std::uint64_t bits = v_.uniform[b] < 0.0f ? 0 : ~std::uint64_t(0);
        if (slot >= 0) {
          bits = 0;
          const float* value = &v_.value[std::size_t(slot) * kCells + 64 * k];
          for (std::size_t c = 0; c < 64; ++c) bits |= std::uint64_t(value[c] < 0.0f ? 0 : 1) << c;
        }
        open_[b][k] = bits;
      }
    });
  }

  void run() {
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      const Index at = v_.brick_at(b);
      for (std::size_t a = 0; a < 3; ++a) {
        if (at[a] == 0) enter(b, face(int(a), 0));
        if (at[a] + 1 == v_.bricks[a]) enter(b, face(int(a), kSide - 1));
      }
    }
    while (!work_.empty()) {
      const std::size_t b = work_.back();
      work_.pop_back();
      spread(b);
      leave(b);
    }
  }

  bool reached(std::size_t brick, std::size_t cell) const {
    return (reached_[brick][cell >> 6] >> (cell & 63) & 1) != 0;
  }

 private:
  using Bits = std::array<std::uint64_t, kSide>;  // a layer in each word, i fastest
  static constexpr std::uint64_t kColumn = 0x0101010101010101u, kRow = 0xffu;

  /// All samples of the outermost layer on one side.
  static Bits face(int axis, int layer) {
    Bits out{};
    for (int k = 0; k < kSide; ++k) {
      if (axis == 0) out[std::size_t(k)] = kColumn << layer;
      if (axis == 1) out[std::size_t(k)] = kRow << (8 * layer);
      if (axis == 2) out[std::size_t(k)] = k == layer ? ~std::uint64_t(0) : 0;
    }
    return out;
  }

  void enter(std::size_t b, const Bits& from) {
    bool any = false;
    for (std::size_t k = 0; k < kSide; ++k) {
      const std::uint64_t more = from[k] & open_[b][k] & ~reached_[b][k];
      reached_[b][k] |= more;
      any |= more != 0;
    }
    if (any) work_.push_back(b);
  }

  /// Within a brick.
  void spread(std::size_t b) {
    Bits& r = reached_[b];
    const Bits& open = open_[b];
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = 0; k < kSide; ++k) {
        std::uint64_t next = r[k] | r[k] << 8 | r[k] >> 8;
        next |= (r[k] & ~(kColumn << 7)) << 1 | (r[k] & ~kColumn) >> 1;
        if (k > 0) next |= r[k - 1];
        if (k + 1 < kSide) next |= r[k + 1];
        next &= open[k];
        changed |= next != r[k];
        r[k] = next;
      }
    }
  }

  /// Into the bricks around.
  void leave(std::size_t b) {
    const Index at = v_.brick_at(b);
    const Bits& r = reached_[b];
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        Index next = at;
        next[std::size_t(axis)] += side;
        if (!v_.contains(next)) continue;
        const Bits own = face(axis, side < 0 ? 0 : kSide - 1);
        Bits out{};
        for (std::size_t k = 0; k < kSide; ++k) {
          const std::uint64_t bits = r[k] & own[k];
          if (axis == 0) out[k] = side < 0 ? bits << 7 : bits >> 7;
          if (axis == 1) out[k] = side < 0 ? bits << 56 : bits >> 56;
        }
        if (axis == 2) out[side < 0 ? kSide - 1 : 0] = r[side < 0 ? 0 : kSide - 1];
        enter(v_.brick_index(next), out);
      }
    }
  }

  const Volume& v_;
  std::vector<Bits> open_, reached_;
  std::vector<std::size_t> work_;
};

}  // namespace turnscan::detail
