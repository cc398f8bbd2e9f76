#include <algorithm>
#include <turnscan/reconstruction/poisson/poisson_bricks.hpp>

namespace turnscan::poisson {
namespace {

/// Along one axis, the part of a block that comes from a neighbour.
struct HaloPart {
  int to, from, count;  // first cell in the block, in the neighbour, and their number
};
constexpr HaloPart kParts[3] = {{-kHalo, kSide - kHalo, kHalo}, {0, 0, kSide}, {kSide, 0, kHalo}};

/// Fills the cells beyond the lower or upper face of the cube across one axis.
void mirror(Block& out, int axis, bool upper) {
  int at[3];
  for (at[2] = -kHalo; at[2] < kSide + kHalo; ++at[2]) {
    for (at[1] = -kHalo; at[1] < kSide + kHalo; ++at[1]) {
      for (at[0] = -kHalo; at[0] < kSide + kHalo; ++at[0]) {
        if (upper ? at[axis] < kSide : at[axis] >= 0) continue;
        int from[3] = {at[0], at[1], at[2]};
        from[axis] = (upper ? 2 * kSide : 0) - 1 - at[axis];
        out[in_block(at[0], at[1], at[2])] = -out[in_block(from[0], from[1], from[2])];
      }
    }
  }
}

}  // namespace

SparseBricks::SparseBricks(int depth)
    : depth_(depth),
      grid_({(1 << depth) / kSide, (1 << depth) / kSide, (1 << depth) / kSide}),
      slot_(grid_.count(), -1) {}

void SparseBricks::add(const Index& b) {
  if (!contains(b) || slot_[grid_.at(b)] >= 0) return;
  slot_[grid_.at(b)] = static_cast<std::int32_t>(bricks_.size());
  bricks_.push_back(b);
}

Neighbours SparseBricks::neighbours(const Index& b) const {
  Neighbours out;
  for (int c = 0; c < 27; ++c)
    out[std::size_t(c)] = slot({b[0] + c % 3 - 1, b[1] + c / 3 % 3 - 1, b[2] + c / 9 - 1});
  return out;
}

void SparseBricks::gather(const Field& field, std::size_t slot, Block& out) const {
  const Index& b = bricks_[slot];
  const auto with_values = std::int32_t(field.size() / kCells);
  const Neighbours from = neighbours(b);
  for (int c = 0; c < 27; ++c) {
    const HaloPart &x = kParts[c % 3], &y = kParts[c / 3 % 3], &z = kParts[c / 9];
    const std::int32_t s = from[std::size_t(c)];
    const float* values = s >= 0 && s < with_values ? &field[std::size_t(s) * kCells] : nullptr;
    for (int k = 0; k < z.count; ++k) {
      for (int j = 0; j < y.count; ++j) {
        float* to = &out[in_block(x.to, y.to + j, z.to + k)];
        if (values)
          std::copy_n(values + in_brick(x.from, y.from + j, z.from + k), x.count, to);
        else
          std::fill_n(to, x.count, 0.0f);
      }
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (b[std::size_t(axis)] == 0) mirror(out, axis, false);
    if (b[std::size_t(axis)] == side() - 1) mirror(out, axis, true);
  }
}

}  // namespace turnscan::poisson
