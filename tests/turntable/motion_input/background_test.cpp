#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/random.hpp>
#include <turnscan/turntable/motion_input/background.hpp>
#include <turnscan/turntable/motion_input/static_background.hpp>

#include "tests/support/memory_sequence.hpp"

namespace turnscan::motion {
namespace {

constexpr int kColumns = 120, kRows = 90;
constexpr double kFocal = 250.0, kPillarNoise_m = 0.0015;

/// A pillar with ribs turns about an upright axis 0.8 m away, beside its own, perhaps before a
/// wall.
class Pillar {
 public:
  explicit Pillar(double wall_m, double ribs = 4.0) : wall_m_(wall_m), ribs_(ribs) {}

  /// 0: nothing.
  double depth(double column, double turn) const {
    const double slope = (column - kColumns / 2) / kFocal;
    for (double z = 0.7; z < 0.82; z += 0.0005) {
      const double x = slope * z - 0.015 * std::cos(turn), back = 0.8 - z - 0.015 * std::sin(turn);
      const double radius = 0.04 + 0.005 * std::cos(ribs_ * (std::atan2(x, back) + turn));
      if (std::hypot(x, back) <= radius) return z;
    }
    return wall_m_;
  }

  testing::MemorySequence turning(int frames) const {
    testing::MemorySequence out;
    SensorInfo sensor;
    sensor.intrinsics.width = kColumns, sensor.intrinsics.height = kRows;
    sensor.intrinsics.fx = sensor.intrinsics.fy = kFocal;
    sensor.intrinsics.cx = kColumns / 2, sensor.intrinsics.cy = kRows / 2;
    sensor.depth_unit_m = 1e-4;
    out.header_value.sensors.push_back(sensor);
    for (int f = 0; f < frames; ++f) out.add(frame(f, 2.0 * std::numbers::pi * f / frames));
    return out;
  }

 private:
  Frame frame(int number, double turn) const {
    Frame out;
    out.depth.width = kColumns, out.depth.height = kRows;
    out.depth.pixels.assign(std::size_t(kColumns * kRows), kNoReturn);
    for (int x = 0; x < kColumns; ++x) {
      const double z = depth(x, turn);
      if (!(z > 0.0)) continue;
      for (int y = 0; y < kRows; ++y) {
        const auto i = std::size_t(y * kColumns + x);
        const double normal = standard_normal(hash_key(std::uint64_t(number), i));
        out.depth.pixels[i] = std::uint16_t(std::lround((z + kPillarNoise_m * normal) * 1e4));
      }
    }
    return out;
  }

  double wall_m_, ribs_;
};

std::vector<std::size_t> all_of(const testing::MemorySequence& frames) {
  std::vector<std::size_t> out(frames.infos.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = i;
  return out;
}

TEST(FindBackground, WithoutARoomNothingOfTheObjectIsCutOff) {
  const auto frames = Pillar(0.0).turning(24);
  const auto found = find_background(frames, all_of(frames), kPillarNoise_m, {});
  ASSERT_TRUE(found) << found.error().text();
  int moving = 0;
  for (const float limit : found->nearer_than) {
    if (limit == 0.0f) continue;
    ++moving;
    EXPECT_TRUE(std::isinf(limit));
  }
  EXPECT_GT(moving, 1000);
}

TEST(FindBackground, BeforeAWallTheLimitLiesBetweenWallAndObject) {
  const Pillar pillar(1.1);
  const auto frames = pillar.turning(24);
  const auto found = find_background(frames, all_of(frames), kPillarNoise_m, {});
  ASSERT_TRUE(found) << found.error().text();
  int beside = 0;
  for (int x = 0; x < kColumns; ++x) {
    double farthest = 0.0;
    for (int f = 0; f < 48; ++f)
      farthest = std::max(farthest, pillar.depth(x, 2.0 * std::numbers::pi * f / 48.0));
    for (int y = 10; y < kRows - 10 && farthest > 1.0; ++y) {
      const float limit = found->nearer_than[std::size_t(y * kColumns + x)];
      if (limit == 0.0f || std::isinf(limit)) continue;
      EXPECT_GT(limit, 0.85) << x << " " << y;
      EXPECT_LT(limit, 1.1) << x << " " << y;
      ++beside;
    }
  }
  EXPECT_GT(beside, 100);
}

/// Each frame cut to what lies near the object, as some data sets are published.
testing::MemorySequence cut_out(testing::MemorySequence frames) {
  const auto count = frames.data.size();
  for (std::size_t f = 0; f < count; ++f) {
    const double turn = 2.0 * std::numbers::pi * double(f) / double(count);
    const int middle = kColumns / 2 + int(5.0 * std::cos(turn));
    const int half = 22 + int(14.0 * std::pow(std::sin(turn), 2));
    auto& pixels = frames.data[f].depth.pixels;
    for (std::size_t i = 0; i < pixels.size(); ++i)
      if (std::abs(int(i) % kColumns - middle) > half) pixels[i] = kNoReturn;
  }
  return frames;
}

TEST(FindBackground, OfFramesCutToTheObjectTheWallIsNoObject) {
  const auto frames = cut_out(Pillar(1.1).turning(24));
  const auto found = find_background(frames, all_of(frames), kPillarNoise_m, {});
  ASSERT_TRUE(found) << found.error().text();
  int object = 0, wall = 0;
  for (const float limit : found->nearer_than) {
    object += limit > 0.82f ? 1 : 0;
    wall += limit > 1.1f ? 1 : 0;
  }
  EXPECT_GT(object, 1000);
  EXPECT_LT(wall, object / 4);  // where the object hides it always, there is no limit
}

TEST(SpatialNoise, FeaturesOfAnObjectAreNoNoise) {
  const auto frames = Pillar(0.0, 7.0).turning(4);
  const auto noise = spatial_noise(frames, all_of(frames), {});
  ASSERT_TRUE(noise) << noise.error().text();
  EXPECT_FALSE(noise->correlated());
  EXPECT_NEAR(noise->sigma_m, kPillarNoise_m, 0.35 * kPillarNoise_m);
}

/// A floor that rises, seen around a square; candidates within the square.
StaticBackground floor_around_a_square(double candidate_m) {
  StaticBackground out;
  out.width = out.height = 80;
  for (int i = 0; i < 6400; ++i) {
    const int x = i % 80, y = i / 80;
    const bool within = x >= 20 && x < 60 && y >= 20 && y < 60;
    const auto z = float(1.0 / (0.8 + 0.002 * y + 0.001 * x));
    out.seen.push_back(within ? 0.0f : z);
    out.candidate.push_back(within ? (candidate_m > 0.0 ? float(candidate_m) : z) : 0.0f);
    out.tolerance.push_back(0.006f);
  }
  return out;
}

std::ptrdiff_t reached(const StaticBackground& depths) {
  const auto found = continued_from_seen(depths);
  return std::count(found.begin(), found.end(), 1);
}

TEST(ContinuedFromSeen, AFloorContinuesBelowWhatStandsOnIt) {
  EXPECT_EQ(reached(floor_around_a_square(0.0)), 1600);
}

TEST(ContinuedFromSeen, ThingsBeforeTheFloorAreNotIt) {
  EXPECT_EQ(reached(floor_around_a_square(0.9)), 0);
}

TEST(ContinuedFromSeen, TheAxisOfAnObjectIsNoFloor) {
  StaticBackground depths = floor_around_a_square(0.0);
  for (int i = 0; i < 6400; ++i) {
    const int x = i % 80, y = i / 80;
    const bool middle = x >= 35 && x < 45 && y >= 35 && y < 45;
    auto &seen = depths.seen[std::size_t(i)], &candidate = depths.candidate[std::size_t(i)];
    seen = middle ? candidate : 0.0f;
    if (middle) candidate = 0.0f;
  }
  EXPECT_EQ(reached(depths), 0);
}

}  // namespace
}  // namespace turnscan::motion
