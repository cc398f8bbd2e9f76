#pragma once
// Small volumes of what stands on a platter, their holes not closed yet.

#include <turnscan/reconstruction/tsdf/volume_samples.hpp>

namespace turnscan::tsdf::testing {

constexpr int kFloor = 5;  // layers of 1 mm; the first lies half of one below y = 0

/// 48 mm wide around the axis, in samples of 1 mm. Distances as distance(position) says; known from
/// layer kFloor on, where known(position) says so.
template <class Distance, class Known>
Volume volume_on_platter(int bricks_high, const Distance& distance, const Known& known) {
  Volume volume;
  volume.cell_m = 0.001;
  volume.truncation_m = 0.004;
  volume.origin_m = Vec3d(-0.024, -0.0005, -0.024);
  volume.set_bricks({6, bricks_high, 6});
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    volume.allocate(b, float(volume.truncation_m));
    const GridCoords at = volume.bricks.coords(b);
    for (int c = 0; c < int(kBrickSamples); ++c) {
      const int i = c & 7, j = c >> 3 & 7, k = c >> 6;
      const std::size_t s = volume.first_sample(b) + sample_in_brick(i, j, k);
      const int layer = at[1] * kBrickSide + j;
      const Vec3d p = volume.position(at[0] * kBrickSide + i, layer, at[2] * kBrickSide + k);
      volume.value[s] = float(distance(p));
      volume.weight[s] = layer >= kFloor && known(p) ? 1.0f : 0.0f;
    }
  }
  return volume;
}

}  // namespace turnscan::tsdf::testing
