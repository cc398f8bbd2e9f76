#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/outside_flood.hpp>

namespace turnscan::tsdf {

namespace {

constexpr std::uint64_t kFirstColumn = 0x0101010101010101u, kFirstRow = 0xffu;

}  // namespace

OutsideFlood::OutsideFlood(const Volume& volume)
    : v_(volume), open_(volume.brick_count()), reached_(volume.brick_count()) {
  open_bricks();
  enter_from_beyond();
  while (!work_.empty()) {
    const std::size_t b = work_.back();
    work_.pop_back();
    spread_within(b);
    spread_beyond(b);
  }
}

/// Marks the samples that are not inside.
void OutsideFlood::open_bricks() {
  parallel_for(v_.brick_count(), 64, [&](std::size_t b) {
    for (std::size_t k = 0; k < kBrickSide; ++k) {
      std::uint64_t bits = v_.uniform[b] < 0.0f ? 0 : ~std::uint64_t(0);
      if (v_.slot[b] >= 0) {
        bits = 0;
        const float* value = &v_.value[v_.first_sample(b) + kBrickLayer * k];
        for (std::size_t c = 0; c < kBrickLayer; ++c)
          bits |= std::uint64_t(value[c] < 0.0f ? 0 : 1) << c;
      }
      open_[b][k] = bits;
    }
  });
}

void OutsideFlood::enter_from_beyond() {
  for (std::size_t b = 0; b < v_.brick_count(); ++b) {
    const GridCoords at = v_.bricks.coords(b);
    for (std::size_t a = 0; a < 3; ++a) {
      if (at[a] == 0) enter(b, face(int(a), 0));
      if (at[a] + 1 == v_.bricks.size()[a]) enter(b, face(int(a), kBrickSide - 1));
    }
  }
}

/// All samples of the outermost layer on one side.
OutsideFlood::BrickBits OutsideFlood::face(int axis, int layer) {
  BrickBits out{};
  for (int k = 0; k < kBrickSide; ++k) {
    if (axis == 0) out[std::size_t(k)] = kFirstColumn << layer;
    if (axis == 1) out[std::size_t(k)] = kFirstRow << (8 * layer);
    if (axis == 2) out[std::size_t(k)] = k == layer ? ~std::uint64_t(0) : 0;
  }
  return out;
}

void OutsideFlood::enter(std::size_t b, const BrickBits& from) {
  bool any = false;
  for (std::size_t k = 0; k < kBrickSide; ++k) {
    const std::uint64_t more = from[k] & open_[b][k] & ~reached_[b][k];
    reached_[b][k] |= more;
    any |= more != 0;
  }
  if (any) work_.push_back(b);
}

void OutsideFlood::spread_within(std::size_t b) {
  BrickBits& r = reached_[b];
  const BrickBits& open = open_[b];
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t k = 0; k < kBrickSide; ++k) {
      std::uint64_t next = r[k] | r[k] << 8 | r[k] >> 8;
      next |= (r[k] & ~(kFirstColumn << 7)) << 1 | (r[k] & ~kFirstColumn) >> 1;
      if (k > 0) next |= r[k - 1];
      if (k + 1 < kBrickSide) next |= r[k + 1];
      next &= open[k];
      changed |= next != r[k];
      r[k] = next;
    }
  }
}

/// Into the six bricks around.
void OutsideFlood::spread_beyond(std::size_t b) {
  const GridCoords at = v_.bricks.coords(b);
  const BrickBits& r = reached_[b];
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      GridCoords next = at;
      next[std::size_t(axis)] += side;
      if (!v_.bricks.contains(next)) continue;
      const BrickBits own = face(axis, side < 0 ? 0 : kBrickSide - 1);
      BrickBits out{};
      for (std::size_t k = 0; k < kBrickSide; ++k) {
        const std::uint64_t bits = r[k] & own[k];
        if (axis == 0) out[k] = side < 0 ? bits << 7 : bits >> 7;
        if (axis == 1) out[k] = side < 0 ? bits << 56 : bits >> 56;
      }
      if (axis == 2) out[side < 0 ? kBrickSide - 1 : 0] = r[side < 0 ? 0 : kBrickSide - 1];
      enter(v_.bricks.at(next), out);
    }
  }
}

}  // namespace turnscan::tsdf
