// What a matcher of windows does to its depth image.

#include <cmath>
#include <limits>
#include <tests/simulator/noise/noise_scenes.hpp>

namespace turnscan {
namespace {

using namespace test;

ScannerModel stereo() {
  ScannerModel m = camera(120, 90, 400.0);
  m.sensing = Sensing::kStereo;
  m.emitter_m = Vec3d(0.05, 0.0, 0.0);
  m.noise.disparity_sigma_px = 0.08;
  return m;
}

NoiseOptions with_window(int px) {
  NoiseOptions options = noise_of("model");
  options.window_px = px;
  return options;
}

/// Errors of a wall's pixels in units of sigma, and their mean product with those (dx, dy) away.
double product(const MeasuredGrid& out, double z, double sigma, int dx, int dy) {
  const int w = out.rect.width(), h = out.rect.height();
  double sum = 0.0;
  int n = 0;
  for (int y = 0; y + dy < h; ++y) {
    for (int x = 0; x + dx < w; ++x, ++n) {
      const auto at = [&](int u, int v) {
        return (double(out.z[std::size_t(v * w + u)]) - z) / sigma;
      };
      sum += at(x, y) * at(x + dx, y + dy);
    }
  }
  return sum / n;
}

TEST(MatchingWindow, MakesErrorsAlikeByTheShareOfTheWindowsThatOverlaps) {
  const Bench bench(stereo(), {wall(1.0)});
  const double sigma = 0.08 / (400.0 * 0.05);
  const std::vector<std::pair<int, int>> shifts = {{0, 0}, {1, 0}, {0, 2}, {3, 3}, {9, 0}};
  for (const int px : {1, 5, 9}) {
    std::vector<double> found(shifts.size());
    for (std::uint32_t frame = 0; frame < 40; ++frame) {
      const auto measured = bench.measure(with_window(px), frame);
      for (std::size_t i = 0; i < shifts.size(); ++i)
        found[i] += product(measured, 1.0, sigma, shifts[i].first, shifts[i].second) / 40.0;
    }
    for (std::size_t i = 0; i < shifts.size(); ++i) {
      const auto [dx, dy] = shifts[i];
      const double overlap =
          std::max(0.0, 1.0 - double(dx) / px) * std::max(0.0, 1.0 - double(dy) / px);
      EXPECT_NEAR(found[i], overlap, 0.05) << px << ": " << dx << " " << dy;
    }
  }
}

TEST(MatchingWindow, IsOfScannersThatMatchOnly) {
  ScannerModel model = stereo();
  model.sensing = Sensing::kTimeOfFlight;
  const Bench bench(model, {wall(1.0)});
  EXPECT_EQ(bench.measure(with_window(9)).z, bench.measure(with_window(1)).z);
}

TEST(EdgeFattening, LetsTheForegroundGrowByItsPixelsAndNoMore) {
  ScannerModel model = stereo();
  model.emitter_m = Vec3d::Zero();
  // The edge lies between columns 59 and 60.
  const Bench bench(model, {half_wall(0.8, 0.0), wall(1.2)});
  const auto last_near = [&](double px) {
    NoiseOptions options = noise_of("none");
    options.edge_fattening_px = px;
    const MeasuredGrid out = bench.measure(options);
    int last = -1;
    for (int x = 0; x < 120; ++x) {
      const float z = out.z[std::size_t(45 * 120 + x)];
      EXPECT_TRUE(z == 0.8f || std::abs(z - 1.2f) < 1e-6f);  // nothing between
      if (z < 1.0f) last = x;
    }
    return last;
  };
  EXPECT_EQ(last_near(0.0), 59);
  EXPECT_EQ(last_near(1.0), 60);
  EXPECT_EQ(last_near(4.0), 63);
  model.sensing = Sensing::kTimeOfFlight;
  const Bench other(model, {half_wall(0.8, 0.0), wall(1.2)});
  NoiseOptions options = noise_of("none");
  const MeasuredGrid plain = other.measure(options);
  options.edge_fattening_px = 4.0;
  EXPECT_EQ(other.measure(options).z, plain.z);
}

TEST(EdgeFattening, LeavesASlantedWallAlone) {
  const Bench bench(stereo(), {wall(1.0, 1.2)});
  NoiseOptions options = noise_of("none");
  const MeasuredGrid plain = bench.measure(options);
  options.edge_fattening_px = 5.0;
  std::size_t other = 0;
  const MeasuredGrid fat = bench.measure(options);
  for (std::size_t i = 0; i < plain.z.size(); ++i)
    other += plain.z[i] > 0.0f && fat.z[i] != plain.z[i] ? 1 : 0;
  EXPECT_EQ(other, 0u);
}

TEST(MatchingOptions, RefuseValuesOutsideTheirRange) {
  NoiseOptions options;
  for (const int bad : {0, 32}) {
    options.window_px = bad;
    EXPECT_FALSE(SensorNoise::create(stereo(), options, 1, 0)) << bad;
  }
  options.window_px = 1;
  for (const double bad : {-1.0, 16.0, std::numeric_limits<double>::quiet_NaN()}) {
    options.edge_fattening_px = bad;
    EXPECT_FALSE(SensorNoise::create(stereo(), options, 1, 0)) << bad;
  }
}

}  // namespace
}  // namespace turnscan
