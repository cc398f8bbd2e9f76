// Noise of a simulated Kinect v2 beside that of a real one: a frame of a sandbox (open_AR_Sandbox).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <tests/simulator/noise/noise_scenes.hpp>
#include <tests/support/shared_data.hpp>
#include <vector>

namespace turnscan {
namespace {

using Depth = std::function<double(int column, int row)>;  ///< millimetres, 0: none

constexpr int kReach = 4;  // patches of 9 x 9 pixels

struct Patch {
  double sigma_mm = 0.0;  ///< about the plane through it
  double alike = 0.0;     ///< correlation of neighbours in a row
};

/// About (u, v); sigma 0 where a depth is missing, out of [low, high] or at a step.
Patch patch_at(const Depth& depth, int u, int v, double low, double high) {
  constexpr int kSide = 2 * kReach + 1;
  double z[kSide][kSide], mean = 0.0, slope_x = 0.0, slope_y = 0.0, square = 0.0;
  double least = 1e9, most = 0.0;
  for (int y = -kReach; y <= kReach; ++y) {
    for (int x = -kReach; x <= kReach; ++x) {
      const double here = depth(u + x, v + y);
      least = std::min(least, here);
      most = std::max(most, here);
      mean += here;
      slope_x += x * here;
      slope_y += y * here;
      square += x * x;
      z[y + kReach][x + kReach] = here;
    }
  }
  constexpr int kCount = kSide * kSide;
  mean /= kCount;
  if (!(least > 0.0) || most - least > 60.0 || mean < low || mean > high) return {};
  double squares = 0.0, products = 0.0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      z[y][x] -= mean + (slope_x * (x - kReach) + slope_y * (y - kReach)) / square;
      squares += z[y][x] * z[y][x];
      if (x > 0) products += z[y][x] * z[y][x - 1];
    }
  }
  const double variance = squares / (kCount - 3);
  return {std::sqrt(variance), products / (kSide * (kSide - 1)) / variance};
}

struct Noise {
  Patch median;
  std::size_t patches = 0;
};

Noise noise_of_image(const Depth& depth, int width, int height, double low, double high) {
  std::vector<double> sigma, alike;
  for (int v = kReach + 1; v + kReach + 1 < height; v += 6) {
    for (int u = kReach + 1; u + kReach + 1 < width; u += 6) {
      const Patch p = patch_at(depth, u, v, low, high);
      if (!(p.sigma_mm > 0.0)) continue;
      sigma.push_back(p.sigma_mm);
      alike.push_back(p.alike);
    }
  }
  if (sigma.empty()) return {};
  const auto middle = std::ptrdiff_t(sigma.size() / 2);
  std::nth_element(sigma.begin(), sigma.begin() + middle, sigma.end());
  std::nth_element(alike.begin(), alike.begin() + middle, alike.end());
  return {{sigma[std::size_t(middle)], alike[std::size_t(middle)]}, sigma.size()};
}

/// An array of 16 bit numbers as numpy writes it (format 1.0).
std::vector<std::uint16_t> read_npy(const std::filesystem::path& path, std::size_t count) {
  std::ifstream in(path, std::ios::binary);
  char start[10] = {};
  in.read(start, sizeof start);
  std::uint16_t header = 0;
  std::memcpy(&header, start + 8, sizeof header);
  in.seekg(10 + header);
  std::vector<std::uint16_t> values(count);
  in.read(reinterpret_cast<char*>(values.data()), std::streamsize(2 * count));
  EXPECT_TRUE(in.good()) << path;
  return values;
}

TEST(KinectV2BesideARealOne, SpreadAndLikenessOfNeighboursAgree) {
  const auto path = testing::shared_data("kinect2/arsandbox_depth.npy");
  TURNSCAN_NEEDS_DATA(path);
  const std::vector<std::uint16_t> image = read_npy(path, 512 * 424);
  const Noise real = noise_of_image(
      [&](int u, int v) { return double(image[std::size_t(v * 512 + u)]); }, 512, 424, 1150, 1300);
  ASSERT_GT(real.patches, 500u);

  // Sand at 1.25 m, in whole millimetres, too.
  ScannerModel m = test::camera(240, 200, 365.5);
  m.near_m = 0.5;
  m.far_m = 4.5;
  m.noise.physics = SensorPhysics::kKinectV2;
  test::Bench bench(m, {test::wall(1.25)});
  bench.set_albedo([](auto, auto, auto) { return 0.5f; });
  const MeasuredGrid out = bench.measure(test::noise_of("physics"));
  const Noise simulated = noise_of_image(
      [&](int u, int v) { return std::round(1e3 * double(out.z[bench.exact().index(u, v)])); }, 240,
      200, 1150, 1300);
  ASSERT_GT(simulated.patches, 500u);
  EXPECT_NEAR(simulated.median.sigma_mm, real.median.sigma_mm, 0.2 * real.median.sigma_mm);
  EXPECT_NEAR(simulated.median.alike, real.median.alike, 0.15);
}

}  // namespace
}  // namespace turnscan
