#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/outside_flood.hpp>

namespace turnscan::tsdf {

OutsideFlood::OutsideFlood(const Volume& volume)
    : v_(volume), open_(volume.bricks), reached_(volume.bricks) {
  open_bricks();
  enter_from_beyond();
  while (!work_.empty()) {
    const std::size_t b = work_.back();
    work_.pop_back();
    fill_brick(b);
    enter_neighbours(b);
  }
}

/// Marks the samples that are not inside.
void OutsideFlood::open_bricks() {
  parallel_for(v_.brick_count(), 64, [&](std::size_t b) {
    if (v_.slot[b] < 0) {
      if (!(v_.uniform[b] < 0.0f)) open_.brick(b).fill(kWholeLayer);
      return;
    }
    const float* values = &v_.value[v_.first_sample(b)];
    for (std::size_t c = 0; c < kBrickSamples; ++c)
      if (!(values[c] < 0.0f)) insert(c, open_.brick(b));
  });
}

void OutsideFlood::enter_from_beyond() {
  BrickBits beyond;
  beyond.fill(kWholeLayer);
  for (std::size_t b = 0; b < v_.brick_count(); ++b) {
    const GridCoords at = v_.bricks.coords(b);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = std::size_t(axis);
      if (at[a] == 0) enter(b, spread_from(beyond, axis, -1));
      if (at[a] + 1 == v_.bricks.size()[a]) enter(b, spread_from(beyond, axis, 1));
    }
  }
}

void OutsideFlood::enter(std::size_t b, const BrickBits& from) {
  const BrickBits& open = open_.brick(b);
  BrickBits& reached = reached_.brick(b);
  bool any = false;
  for (std::size_t k = 0; k < kBrickSide; ++k) {
    const std::uint64_t more = from[k] & open[k] & ~reached[k];
    reached[k] |= more;
    any |= more != 0;
  }
  if (any) work_.push_back(b);
}

void OutsideFlood::fill_brick(std::size_t b) {
  const BrickBits& open = open_.brick(b);
  BrickBits& reached = reached_.brick(b);
  for (BrickBits before{}; before != reached;) {
    before = reached;
    reached = spread_within(before);
    for (std::size_t k = 0; k < kBrickSide; ++k) reached[k] &= open[k];
  }
}

void OutsideFlood::enter_neighbours(std::size_t b) {
  const GridCoords at = v_.bricks.coords(b);
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      GridCoords next = at;
      next[std::size_t(axis)] += side;
      if (v_.bricks.contains(next))
        enter(v_.bricks.at(next), spread_from(reached_.brick(b), axis, -side));
    }
  }
}

}  // namespace turnscan::tsdf
