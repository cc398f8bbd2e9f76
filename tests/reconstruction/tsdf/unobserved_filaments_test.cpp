#include <gtest/gtest.h>

#include <cmath>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/tsdf/unobserved_filaments.hpp>

namespace turnscan::tsdf {
namespace {

constexpr int kLumpSide = 24;  // samples; three bricks

/// Signs and knowledge of all samples; bricks of one kind only may be left without samples.
template <class Inside, class Known>
Volume volume_of(const Inside& inside, const Known& known) {
  Volume volume;
  volume.cell_m = 1.0;
  volume.truncation_m = 3.0;
  volume.set_bricks({kLumpSide / 8, kLumpSide / 8, kLumpSide / 8});
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    volume.allocate(b, 1.0f);
    const GridCoords at = volume.bricks.coords(b);
    for (int c = 0; c < 512; ++c) {
      const int i = at[0] * 8 + (c & 7), j = at[1] * 8 + (c >> 3 & 7), k = at[2] * 8 + (c >> 6);
      const std::size_t s = volume.first_sample(b) + std::size_t(c);
      volume.value[s] = inside(i, j, k) ? -1.0f : 1.0f;
      volume.weight[s] = known(i, j, k) ? 1.0f : 0.0f;
    }
  }
  return volume;
}

bool contains(const SampleBits& set, const Volume& volume, int i, int j, int k) {
  const std::size_t s = sample_in_brick(i, j, k);
  return (set.brick(volume.bricks.at({i / 8, j / 8, k / 8}))[s >> 6] >> (s & 63) & 1) != 0;
}

std::size_t count(const SampleBits& set, const Volume& volume) {
  std::size_t n = 0;
  for (int k = 0; k < kLumpSide; ++k)
    for (int j = 0; j < kLumpSide; ++j)
      for (int i = 0; i < kLumpSide; ++i) n += contains(set, volume, i, j, k) ? 1 : 0;
  return n;
}

const auto known_nowhere = [](int, int, int) { return false; };

/// A rod along x through the middle.
auto rod_through(int radius) {
  return [radius](int, int j, int k) { return std::hypot(j - 12, k - 12) <= radius + 0.5; };
}

TEST(GuessedThreads, AreThinnerThanTwiceTheRadius) {
  const Volume thin = volume_of(rod_through(2), known_nowhere),
               thick = volume_of(rod_through(6), known_nowhere);
  const SampleBits cut = unobserved_filaments(thin, {}, 4),
                   left = unobserved_filaments(thick, {}, 4);
  for (int i = 0; i < kLumpSide; ++i) EXPECT_TRUE(contains(cut, thin, i, 12, 12)) << i;
  for (int i = 0; i < kLumpSide; ++i) EXPECT_FALSE(contains(left, thick, i, 12, 12)) << i;
  EXPECT_FALSE(contains(cut, thin, 12, 20, 12));  // outside
}

TEST(GuessedThreads, WhatFreeSpaceSurroundsStaysWhole) {
  // A band of a thin leg that no view saw: where it is, others saw past it.
  const Volume leg = volume_of(rod_through(2), [](int i, int j, int k) {
    return !rod_through(2)(i, j, k) || i < 8 || i >= 16;
  });
  EXPECT_EQ(count(unobserved_filaments(leg, {}, 4), leg), 0u);
}

TEST(GuessedThreads, WhatWasMeasuredStays) {
  const auto known = [](int i, int, int) { return i < 8; };
  const Volume volume = volume_of(rod_through(2), known);
  const SampleBits cut = unobserved_filaments(volume, {}, 4);
  for (int i = 0; i < 8; ++i) EXPECT_FALSE(contains(cut, volume, i, 12, 12));
  for (int i = 12; i < kLumpSide; ++i) EXPECT_TRUE(contains(cut, volume, i, 12, 12));
}

TEST(GuessedThreads, BricksWithoutSamplesCount) {
  // Inside but for a last layer that was guessed to be outside.
  Volume volume = volume_of([](int i, int, int) { return i < 16; }, known_nowhere);
  Volume sparse;
  sparse.cell_m = 1.0, sparse.truncation_m = 3.0;
  sparse.set_bricks({3, 3, 3});
  std::vector<std::size_t> guessed;
  for (std::size_t b = 0; b < sparse.brick_count(); ++b) {
    sparse.uniform[b] = sparse.bricks.coords(b)[0] < 2 ? -1.0f : 1.0f;
    guessed.push_back(b);
  }
  const SampleBits dense_cut = unobserved_filaments(volume, {}, 9);
  const SampleBits sparse_cut = unobserved_filaments(sparse, guessed, 9);
  EXPECT_EQ(count(dense_cut, volume), 0u);
  EXPECT_EQ(count(sparse_cut, sparse), 0u);
  EXPECT_EQ(count(unobserved_filaments(sparse, guessed, 17), sparse),
            std::size_t(16 * kLumpSide * kLumpSide));
}

/// The definition, sample by sample.
std::vector<bool> plain_threads(const Volume& volume, int radius) {
  const auto at = [](int i, int j, int k) {
    return std::size_t(i + kLumpSide * (j + kLumpSide * k));
  };
  std::vector<bool> inside(kLumpSide * kLumpSide * kLumpSide), unknown = inside;
  for (int k = 0; k < kLumpSide; ++k)
    for (int j = 0; j < kLumpSide; ++j)
      for (int i = 0; i < kLumpSide; ++i) {
        const std::size_t s =
            volume.first_sample(volume.bricks.at({i / 8, j / 8, k / 8})) + sample_in_brick(i, j, k);
        inside[at(i, j, k)] = volume.value[s] < 0.0f;
        unknown[at(i, j, k)] = !(volume.weight[s] > 0.0f);
      }
  const auto grow = [&](std::vector<bool> set) {
    for (int round = 0; round < radius; ++round) {
      const std::vector<bool> old = set;
      for (int k = 0; k < kLumpSide; ++k)
        for (int j = 0; j < kLumpSide; ++j)
          for (int i = 0; i < kLumpSide; ++i) {
            if (!inside[at(i, j, k)]) continue;
            const bool beside =
                (i > 0 && old[at(i - 1, j, k)]) || (j > 0 && old[at(i, j - 1, k)]) ||
                (k > 0 && old[at(i, j, k - 1)]) || (i + 1 < kLumpSide && old[at(i + 1, j, k)]) ||
                (j + 1 < kLumpSide && old[at(i, j + 1, k)]) ||
                (k + 1 < kLumpSide && old[at(i, j, k + 1)]);
            if (beside) set[at(i, j, k)] = true;
          }
    }
    return set;
  };
  std::vector<bool> set(inside.size());
  for (std::size_t s = 0; s < set.size(); ++s) set[s] = unknown[s] && !inside[s];
  set = grow(std::move(set));
  for (std::size_t s = 0; s < set.size(); ++s) set[s] = inside[s] && !set[s];
  set = grow(std::move(set));
  for (std::size_t s = 0; s < set.size(); ++s) set[s] = inside[s] && unknown[s] && !set[s];
  return set;
}

TEST(GuessedThreads, AgreeWithTheirDefinitionOnRandomLumps) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    // Random values on a coarse lattice make lumps and threads.
    const auto lump = [seed](int i, int j, int k, int salt) {
      const auto key = std::uint64_t((i / 3) + 100 * (j / 2) + 10000 * (k / 3));
      return uniform01(hash_key(seed, key, std::uint64_t(salt)));
    };
    const Volume volume = volume_of([&](int i, int j, int k) { return lump(i, j, k, 1) < 0.7; },
                                    [&](int i, int j, int k) { return lump(i, j, k, 2) < 0.4; });
    const SampleBits cut = unobserved_filaments(volume, {}, 2);
    const std::vector<bool> expected = plain_threads(volume, 2);
    std::size_t wrong = 0;
    for (int k = 0; k < kLumpSide; ++k)
      for (int j = 0; j < kLumpSide; ++j)
        for (int i = 0; i < kLumpSide; ++i)
          wrong += contains(cut, volume, i, j, k) !=
                   expected[std::size_t(i + kLumpSide * (j + kLumpSide * k))];
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(count(cut, volume), 100u);
  }
}

}  // namespace
}  // namespace turnscan::tsdf
