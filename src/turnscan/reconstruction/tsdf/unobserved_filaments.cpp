#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/unobserved_filaments.hpp>

namespace turnscan::tsdf {

SampleBits unobserved_filaments(const Volume& volume, const std::vector<std::size_t>& guessed,
                                int radius) {
  SampleBits unknown = unseen_samples(volume), inside(volume.bricks);
  for (const std::size_t b : guessed) unknown.brick(b).fill(kWholeLayer);
  parallel_for(volume.brick_count(), 64, [&](std::size_t b) {
    if (volume.slot[b] < 0) {
      if (volume.uniform[b] < 0.0f) inside.brick(b).fill(kWholeLayer);
      return;
    }
    const float* values = &volume.value[volume.first_sample(b)];
    for (std::size_t c = 0; c < kBrickSamples; ++c)
      if (values[c] < 0.0f) insert(c, inside.brick(b));
  });
  const SampleBits guessed_outside = unknown.minus(inside);
  SampleBits eroded = guessed_outside;
  for (int i = 0; i < radius; ++i) eroded = eroded.grown(inside).joined(guessed_outside);
  SampleBits opened = inside.minus(eroded);
  for (int i = 0; i < radius; ++i) opened = opened.grown(inside);
  return unknown.minus(guessed_outside).minus(opened);
}

}  // namespace turnscan::tsdf
