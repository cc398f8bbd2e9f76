#include <algorithm>
#include <turnscan/reconstruction/tsdf/volume.hpp>

namespace turnscan::tsdf {

Platter platter_of(const Pose& T_object_table) {
  const Vec3d up = T_object_table.linear() * Vec3d::UnitY();
  return {up, up.dot(T_object_table.translation())};
}

double below_platters(std::span<const Platter> platters, const Vec3d& p) {
  double deepest = -1e30;
  for (const Platter& platter : platters) deepest = std::max(deepest, -platter.above(p));
  return deepest;
}

void Volume::set_bricks(const GridCoords& size) {
  bricks = GridIndex(size);
  slot.assign(bricks.count(), -1);
  uniform.assign(bricks.count(), 0.0f);
  value.clear();
  weight.clear();
}

void Volume::allocate(std::size_t brick, float start) {
  slot[brick] = std::int32_t(slots());
  value.insert(value.end(), kBrickSamples, start);
  weight.insert(weight.end(), kBrickSamples, 0.0f);
}

std::vector<std::size_t> Volume::allocated_bricks() const {
  std::vector<std::size_t> out;
  for (std::size_t b = 0; b < brick_count(); ++b) {
    if (slot[b] >= 0) out.push_back(b);
  }
  return out;
}

Result<BrickGrid> to_grid(const Volume& volume, std::size_t max_bytes) {
  const GridCoords& bricks = volume.bricks.size();
  TURNSCAN_ASSIGN(BrickGrid grid, BrickGrid::create(volume.origin_m, volume.cell_m,
                                                    {bricks[0] * kBrickSide, bricks[1] * kBrickSide,
                                                     bricks[2] * kBrickSide},
                                                    1.0f, max_bytes));
  const std::vector<std::size_t> allocated = volume.allocated_bricks();
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    if (volume.slot[b] < 0) grid.uniform(b) = float(volume.uniform[b] * volume.truncation_m);
  }
  TURNSCAN_TRY(grid.allocate(allocated));
  for (const std::size_t b : allocated)
    std::copy_n(&volume.value[volume.first_sample(b)], kBrickSamples, grid.samples(b));
  return grid;
}

}  // namespace turnscan::tsdf
