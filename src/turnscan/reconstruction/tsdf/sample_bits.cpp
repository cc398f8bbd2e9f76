#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/sample_bits.hpp>

namespace turnscan::tsdf {

SampleBits unseen_samples(const Volume& volume) {
  SampleBits out(volume.bricks);
  parallel_for(volume.brick_count(), 64, [&](std::size_t b) {
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
