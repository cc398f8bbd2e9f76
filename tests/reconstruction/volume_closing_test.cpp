#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/volume.hpp>

namespace turnscan {
namespace {

constexpr int kBricks = 3, kSize = 8 * kBricks;

std::size_t sample(const Volume& volume, int i, int j, int k) {
  const auto slot = std::size_t(volume.slot[volume.brick_index({i / 8, j / 8, k / 8})]);
  return slot * 512 + std::size_t(i % 8 + 8 * (j % 8) + 64 * (k % 8));
}

/// All samples known; `share` of them clear, at random, and winding passages between them.
Volume sponge(double share, std::uint64_t seed) {
  Volume volume;
  volume.cell_m = 1.0;
  volume.truncation_m = 3.0;
  volume.bricks = {kBricks, kBricks, kBricks};
  volume.slot.assign(kBricks * kBricks * kBricks, -1);
  volume.uniform.assign(volume.slot.size(), 0.0f);
  for (std::size_t b = 0; b < volume.slot.size(); ++b) volume.touch(b, 0.0f);
  for (std::size_t s = 0; s < volume.value.size(); ++s) {
    volume.value[s] = uniform01(hash_key(seed, s, 0)) < share ? 1.0f : -1.0f;
    volume.weight[s] = 1.0f;
  }
  return volume;
}

/// Which clear samples a walk from the rim reaches, one by one.
std::vector<bool> walked(const Volume& volume) {
  std::vector<bool> reached(volume.value.size(), false);
  std::vector<std::array<int, 3>> stack;
  const auto visit = [&](int i, int j, int k) {
    if (i < 0 || j < 0 || k < 0 || i >= kSize || j >= kSize || k >= kSize) return;
    const std::size_t s = sample(volume, i, j, k);
    if (reached[s] || volume.value[s] < 0.0f) return;
    reached[s] = true;
    stack.push_back({i, j, k});
  };
  for (int a = 0; a < kSize; ++a) {
    for (int b = 0; b < kSize; ++b) {
      for (const int end : {0, kSize - 1}) {
        visit(end, a, b);
        visit(a, end, b);
        visit(a, b, end);
      }
    }
  }
  while (!stack.empty()) {
    const auto [i, j, k] = stack.back();
    stack.pop_back();
    visit(i - 1, j, k), visit(i + 1, j, k);
    visit(i, j - 1, k), visit(i, j + 1, k);
    visit(i, j, k - 1), visit(i, j, k + 1);
  }
  return reached;
}

TEST(CloseVolume, FillsWhatAWalkFromBeyondDoesNotReach) {
  // Where a third is clear, passages just begin to lead through.
  for (const double share : {0.2, 0.3, 0.35, 0.5}) {
    Volume volume = sponge(share, std::uint64_t(1000.0 * share));
    const std::vector<bool> reached = walked(volume);
    VolumeScale scale;
    scale.cell_m = 1.0, scale.truncation_m = 3.0;
    close_volume(volume, scale, RunContext());
    std::size_t wrong = 0;
    for (std::size_t s = 0; s < reached.size(); ++s)
      wrong += (volume.value[s] >= 0.0f) != reached[s] ? 1 : 0;
    EXPECT_EQ(wrong, 0u) << share;
  }
}

}  // namespace
}  // namespace turnscan
