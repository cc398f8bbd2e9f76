#include <algorithm>
#include <cstdlib>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/volume_samples.hpp>

namespace turnscan::tsdf {

namespace {

/// Weighted mean over 3^3 samples, with more weight for closer ones. Unknown ones are unchanged.
float smoothed(const BrickHalo& halo, int i, int j, int k) {
  float sum = 0.0f, total = 0.0f;
  for (int n = 0; n < 27; ++n) {
    const int p = n % 3 - 1, q = n / 3 % 3 - 1, r = n / 9 - 1;
    const std::size_t c = BrickHalo::at(i + p, j + q, k + r);
    const float w = halo.weight[c] / float(1 << (std::abs(p) + std::abs(q) + std::abs(r)));
    sum += w * halo.value[c];
    total += w;
  }
  const std::size_t c = BrickHalo::at(i, j, k);
  return halo.weight[c] > 0.0f ? sum / total : halo.value[c];
}

}  // namespace

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

Result<> smooth(Volume& volume, int rounds, const RunContext& context) {
  const std::vector<std::size_t> bricks = volume.allocated_bricks();
  const VolumeSamples samples(volume);
  std::vector<float> next(volume.value.size());
  for (int round = 0; round < rounds; ++round) {
    const auto smooth_brick = [&](std::size_t b) {
      BrickHalo halo;
      halo.gather(volume, samples, volume.bricks.coords(bricks[b]));
      float* out = &next[volume.first_sample(bricks[b])];
      for (int k = 0; k < kBrickSide; ++k) {
        for (int j = 0; j < kBrickSide; ++j) {
          for (int i = 0; i < kBrickSide; ++i)
            out[sample_in_brick(i, j, k)] = smoothed(halo, i, j, k);
        }
      }
    };
    TURNSCAN_TRY(parallel_for(bricks.size(), 8, context, smooth_brick));
    volume.value.swap(next);
  }
  return {};
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
