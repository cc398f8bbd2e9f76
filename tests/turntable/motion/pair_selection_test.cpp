#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>

namespace turnscan::motion {
namespace {

MotionData frames_with_keys(std::size_t frames, std::size_t every) {
  MotionData data;
  data.frames.resize(frames);
  for (std::size_t i = 0; i < frames; ++i) {
    MotionFrame& frame = data.frames[i];
    frame.pass = i < 2 * frames / 3 ? 0 : 1;
    if (i % 7 != 3) frame.samples.resize(1);
    if (i % every != 0) continue;
    data.keys.push_back(i);
    if (i % 5 != 2) frame.surface.z.resize(1);
  }
  return data;
}

/// Three turns, back and forth on a coarse grid, so that several frames have the same angle.
std::vector<double> angles(std::size_t frames, std::uint64_t seed) {
  std::vector<double> out;
  for (std::size_t i = 0; i < frames; ++i)
    out.push_back(std::floor(3.0 * kTurn * uniform01(hash_key(seed, i)) * 40.0) / 40.0);
  return out;
}

/// By comparison with every key frame.
std::size_t nearest(const MotionData& data, const std::vector<double>& angle, std::size_t frame,
                    double target, double reach) {
  std::size_t best = frame;
  for (const std::size_t k : data.keys) {
    const double off = std::abs(angle[k] - target);
    if (k == frame || data.frames[k].pass != data.frames[frame].pass || off >= reach) continue;
    best = k, reach = off;
  }
  return best;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> by_brute_force(const MotionData& data,
                                                                 const std::vector<double>& angle,
                                                                 bool all_frames) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> out;
  std::vector<std::uint8_t> key(data.frames.size(), 0);
  for (const std::size_t k : data.keys) key[k] = 1;
  const auto add = [&](std::size_t a, std::size_t b) {
    if (a == b) return;
    if (!data.frames[a].samples.empty() && !data.frames[b].surface.empty()) out.emplace(a, b);
    if (key[a] && !data.frames[b].samples.empty() && !data.frames[a].surface.empty())
      out.emplace(b, a);
  };
  const bool few = data.keys.size() <= 24;
  for (std::size_t i = 0; i < data.frames.size(); ++i) {
    if (!key[i] && !all_frames) continue;
    std::vector<double> offsets{0.0};
    if (key[i]) {
      offsets.insert(offsets.end(), {0.2, 0.5, 0.95, 1.4});
      if (few) offsets.insert(offsets.end(), {-0.2, -0.5, -0.95, -1.4});
    } else {
      offsets.insert(offsets.end(), {0.5, -0.5});
    }
    for (const double apart : offsets)
      add(i, nearest(data, angle, i, angle[i] + apart, few ? 1.0 : 0.1));
    for (const double turn : {kTurn, -kTurn, 2 * kTurn})
      for (const double apart : {0.0, 0.25, 0.5, 0.95, -0.25, -0.5, -0.95})
        if (key[i] || apart == 0.0)
          add(i, nearest(data, angle, i, angle[i] + turn + apart, few ? 1.0 : 0.1));
  }
  for (std::size_t k = 0; k + 1 < data.keys.size(); ++k)
    if (data.frames[data.keys[k]].pass == data.frames[data.keys[k + 1]].pass)
      add(data.keys[k], data.keys[k + 1]);
  return out;
}

TEST(PairSelection, EqualsComparisonWithEveryKeyFrame) {
  const std::vector<std::pair<std::size_t, std::size_t>> sizes{{60, 4}, {400, 1}, {900, 6}};
  for (const auto& [frames, every] : sizes) {
    const MotionData data = frames_with_keys(frames, every);
    for (const bool all_frames : {false, true}) {
      const auto angle = angles(frames, frames + every);
      std::set<std::pair<std::uint32_t, std::uint32_t>> found;
      for (const FramePair& pair : select_pairs(data, angle, all_frames))
        EXPECT_TRUE(found.emplace(pair.from, pair.to).second);
      EXPECT_FALSE(found.empty());
      EXPECT_EQ(found, by_brute_force(data, angle, all_frames));
    }
  }
}

}  // namespace
}  // namespace turnscan::motion
