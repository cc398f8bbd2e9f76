#include <cstdlib>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/volume_samples.hpp>

namespace turnscan::tsdf {

namespace {

/// The mean over 3^3 samples by their weights, nearer ones counting more. Unknown ones stay.
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

}  // namespace turnscan::tsdf
