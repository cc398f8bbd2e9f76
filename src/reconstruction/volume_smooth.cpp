#include <cstdlib>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/volume_samples.hpp>

namespace turnscan {

using detail::Halo;
using detail::kCells;
using detail::kSide;
using detail::Samples;
using detail::within;

void smooth(Volume& volume, int rounds) {
  const std::vector<std::size_t> bricks = detail::touched_bricks(volume);
  const Samples samples(volume);
  std::vector<float> next(volume.value.size());
  for (int round = 0; round < rounds; ++round) {
    parallel_for(bricks.size(), 8, [&](std::size_t b) {
      Halo halo;
      halo.gather(volume, samples, volume.brick_at(bricks[b]));
      float* out = &next[std::size_t(volume.slot[bricks[b]]) * kCells];
      for (int k = 0; k < kSide; ++k) {
        for (int j = 0; j < kSide; ++j) {
          for (int i = 0; i < kSide; ++i) {
            float sum = 0.0f, total = 0.0f;
            for (int n = 0; n < 27; ++n) {
              const int p = n % 3 - 1, q = n / 3 % 3 - 1, r = n / 9 - 1;
              const std::size_t c = Halo::at(i + p, j + q, k + r);
              const float w =
                  halo.weight[c] / float(1 << (std::abs(p) + std::abs(q) + std::abs(r)));
              sum += w * halo.value[c];
              total += w;
            }
            const std::size_t c = Halo::at(i, j, k);
            out[within(i, j, k)] = halo.weight[c] > 0.0f ? sum / total : halo.value[c];
          }
        }
      }
    });
    volume.value.swap(next);
  }
}

}  // namespace turnscan
