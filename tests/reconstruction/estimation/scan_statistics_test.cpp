#include <gtest/gtest.h>

#include <cmath>
#include <tests/support/synthetic_cloud.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/estimation/scan_statistics.hpp>

namespace turnscan::estimation {
namespace {

TEST(FrameStatistics, FindTheNoiseAndSpacingOfADepthImage) {
  FramePoints points;
  points.width = 200;
  points.height = 100;
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 200; ++u) {
      const float z = 0.9f + 0.001f * float(u) +
                      float(0.0015 * standard_normal(hash_key(8, std::uint64_t(v * 200 + u))));
      points.cloud.points.emplace_back(0.002f * float(u), 0.002f * float(v), z);
      points.cell.push_back(v * 200 + u);
    }
  const FrameStatistics s = frame_statistics(points);
  EXPECT_NEAR(s.noise_m, 0.0015, 0.00005);
  EXPECT_GT(s.spacing_m, 0.002);
  EXPECT_LT(s.spacing_m, 0.0045);
}

TEST(FrameStatistics, ASteepSurfaceDoesNotSpreadTheSpacingOfTheRays) {
  FramePoints points;
  points.width = 100;
  points.height = 50;
  for (int v = 0; v < points.height; ++v) {
    for (int u = 0; u < points.width; ++u) {
      points.cloud.points.emplace_back(0.002f * float(u), 0.002f * float(v),
                                       0.7f + 0.006f * float(u));
      points.cell.push_back(v * points.width + u);
    }
  }
  const FrameStatistics s = frame_statistics(points);
  EXPECT_NEAR(s.spacing_m, std::hypot(0.002, 0.006), 1e-5);
  EXPECT_NEAR(s.even_spacing_m, 1.25 * 0.002, 1e-5);
}

/// Bars eight pixels wide in front of a wall, each at a depth of its own; the pixel between bar and
/// wall mixes both.
FramePoints bars_before_a_wall(double noise_m) {
  FramePoints points;
  points.width = 200;
  points.height = 60;
  for (int v = 0; v < points.height; ++v) {
    for (int u = 0; u < points.width; ++u) {
      const auto key = hash_key(9, std::uint64_t(v * points.width + u));
      const float bar = 0.85f + 0.003f * float(u / 20 % 7);
      const float mixed = bar + float(uniform01(mix64(key))) * (0.9f - bar);
      const float depth = u % 20 < 8 ? bar : u % 20 == 8 ? mixed : 0.9f;
      points.cloud.points.emplace_back(0.002f * float(u), 0.002f * float(v),
                                       depth + float(noise_m * standard_normal(key)));
      points.cell.push_back(v * points.width + u);
    }
  }
  return points;
}

TEST(FrameStatistics, NoiseOfThinThingsIsThatOfTheSensorNotOfTheirEdges) {
  for (const double noise : {0.0005, 0.0015, 0.003})
    EXPECT_NEAR(frame_statistics(bars_before_a_wall(noise)).noise_m, noise, 0.15 * noise) << noise;
}

TEST(CloudStatistics, FindThicknessAndDensity) {
  const voxels::MergedCloud merged = testing::noisy_plane(200000, 0.05, 0.001);
  const CloudStatistics s = cloud_statistics(merged, 0.002);
  EXPECT_NEAR(s.noise_m, 0.00093, 0.0001);  // two of three sensors look at 32 degrees
  EXPECT_NEAR(s.spacing_m, 0.1 / std::sqrt(200000.0), 0.00005);
}

/// Both faces of a wall, each seen from its own side.
voxels::MergedCloud thin_wall(float thickness_m, double noise_m) {
  voxels::MergedCloud merged;
  for (const float side : {1.0f, -1.0f}) {
    const auto frame = std::uint32_t(merged.viewpoints.size());
    for (std::uint64_t i = 0; i < 60000; ++i) {
      const auto draw = [&](std::uint64_t k) { return uniform01(hash_key(frame, i, k)); };
      merged.cloud.points.emplace_back(
          0.1 * draw(0), 0.1 * draw(1),
          side * (0.5f * thickness_m + float(noise_m * standard_normal(hash_key(frame, i)))));
      merged.cloud.frame.push_back(frame);
    }
    merged.viewpoints.push_back({Vec3d(0.05, 0.05, double(side)), false});
  }
  return merged;
}

TEST(CloudStatistics, TheFacesOfAThinWallAreNoNoise) {
  const voxels::MergedCloud wall = thin_wall(0.004f, 0.001);
  EXPECT_GT(cloud_statistics(wall, 0.003).noise_m, 0.0018);
  EXPECT_NEAR(one_sided_statistics(wall, 0.003, false).noise_m, 0.001, 0.00025);
}

/// The front of rods 4 mm thick, 60 mm apart, seen along z.
voxels::MergedCloud rods(double noise_m) {
  voxels::MergedCloud merged;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const auto draw = [&](std::uint64_t k) { return uniform01(hash_key(11, i, k)); };
    const double across = 0.002 * (2.0 * draw(0) - 1.0);
    merged.cloud.points.emplace_back(
        0.06 * double(i % 4) + across, 0.2 * draw(1),
        std::sqrt(0.002 * 0.002 - across * across) + noise_m * standard_normal(hash_key(12, i)));
    merged.cloud.frame.push_back(0);
  }
  merged.viewpoints.push_back({Vec3d(0.1, 0.1, 1.0), false});
  return merged;
}

TEST(CloudStatistics, ThinRodsAreNoThickerThanTheirNoise) {
  EXPECT_NEAR(one_sided_statistics(rods(0.0015), 0.007, false).noise_m, 0.0015, 0.0004);
}

TEST(CloudStatistics, OfCellsAreThoseOfTheirPoints) {
  const voxels::MergedCloud merged = testing::noisy_plane(200000, 0.05, 0.001);
  const CloudStatistics s = cloud_statistics(testing::measured(merged, 0.001), 0.002);
  EXPECT_NEAR(s.noise_m, 0.00093, 0.0001);
  EXPECT_NEAR(s.spacing_m, 0.1 / std::sqrt(200000.0), 0.00005);
}

/// Lines along X of points 0.5 mm apart, one a frame and 4 mm beside the last.
voxels::MergedCloud lines(std::uint32_t frames) {
  voxels::MergedCloud merged;
  for (std::uint32_t f = 0; f < frames; ++f) {
    for (int i = 0; i < 400; ++i) {
      merged.cloud.points.emplace_back(0.0005f * float(i), 0.0f, 0.004f * float(f));
      merged.cloud.frame.push_back(f);
    }
  }
  return merged;
}

TEST(CloudStatistics, DensityOfLinesIsThatOfTheSurface) {
  EXPECT_NEAR(cloud_statistics(lines(60), 0.0015).spacing_m, std::sqrt(0.0005 * 0.004), 0.0003);
}

TEST(CloudStatistics, FramesOfALineScannerLieApart) {
  EXPECT_NEAR(frames_apart(lines(60), 0.0005), 0.004, 1e-6);
  EXPECT_EQ(frames_apart(lines(1), 0.0005), 0.0);
  EXPECT_LT(frames_apart(testing::noisy_plane(20000, 0.05, 0.001), 0.001), 0.003);
}

}  // namespace
}  // namespace turnscan::estimation
