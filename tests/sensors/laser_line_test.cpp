#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <turnscan/core/random.hpp>
#include <turnscan/sensors/laser_line.hpp>
#include <turnscan/sensors/noise_model.hpp>

namespace turnscan {
namespace {

/// A profile scanner at 0.3 m: 12.5 um a pixel step, a line of 60 um, blue laser.
NoiseModel profiler() {
  NoiseModel m;
  m.physics = SensorPhysics::kLaserLine;
  m.line_width_m = 60e-6;
  m.line_wavelength_m = 405e-9;
  m.line_aperture = 0.02;
  m.line_contrast = 0.0;
  m.line_focal_px = 6000.0;
  m.line_blur_px = 0.8;
  m.line_exposure = 3000.0;
  m.line_read_noise = 10.0;
  m.line_full_well = 20000.0;
  m.line_threshold = 100.0;
  return m;
}

constexpr double kFocalBaseline = 6000.0 * 0.12;

std::vector<LineSpot> flat(const NoiseModel& m, double z, double albedo = 0.5) {
  const std::vector<double> strips = line_strips_m(m);
  const double width = strips.size() > 1 ? strips[1] - strips[0] : m.line_width_m;
  std::vector<LineSpot> spots;
  for (const double x : strips)
    spots.push_back({x, z, line_light(m, z, 0.0, albedo) * line_profile(m, x), width});
  return spots;
}

struct LineStatistics {
  double mean, sigma;
};

template <class Draw>
LineStatistics statistics(int n, const Draw& draw) {
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double v = draw(i);
    sum += v;
    squares += v * v;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean)};
}

std::vector<float> gaussian_peak(double at, double height, double sigma, int n = 40) {
  std::vector<float> column;
  for (int i = 0; i < n; ++i)
    column.push_back(float(height * std::exp(-0.5 * (i - at) * (i - at) / (sigma * sigma))));
  return column;
}

TEST(PeakFinder, FindsAPeakAnywhereBetweenPixels) {
  for (double at = 15.0; at < 17.0; at += 0.03) {
    const auto peak = find_peak(gaussian_peak(at, 1000.0, 1.5), 100.0);
    ASSERT_TRUE(peak);
    EXPECT_NEAR(peak->position_px, at, 0.01) << at;
  }
}

TEST(PeakFinder, TakesTheStrongestPeak) {
  auto column = gaussian_peak(10.0, 800.0, 1.5);
  const auto other = gaussian_peak(30.0, 900.0, 1.5);
  for (std::size_t i = 0; i < column.size(); ++i) column[i] += other[i];
  EXPECT_NEAR(find_peak(column, 100.0)->position_px, 30.0, 0.05);
}

TEST(PeakFinder, SaturatedPeakIsFoundInItsMiddle) {
  auto column = gaussian_peak(20.0, 5000.0, 2.0);
  for (float& v : column) v = std::min(v, 1000.0f);
  EXPECT_NEAR(find_peak(column, 100.0)->position_px, 20.0, 1e-3);
}

TEST(PeakFinder, LowPeaksAndEmptyColumnsAreNone) {
  EXPECT_FALSE(find_peak(gaussian_peak(20.0, 99.0, 1.5), 100.0));
  EXPECT_FALSE(find_peak({}, 0.0));
  EXPECT_FALSE(find_peak(std::vector<float>(20, 0.0f), 0.0));
}

TEST(LaserLine, MeanIsTheDepthAndSigmaIsThePredictedOneWithoutSpeckle) {
  const NoiseModel m = profiler();
  for (const double z : {0.25, 0.3, 0.4}) {
    const auto spots = flat(m, z);
    const LineStatistics s = statistics(4000, [&](int i) {
      return *measure_line(m, kFocalBaseline, spots, hash_key(7, std::uint64_t(i)));
    });
    const double predicted = laser_line_sigma_m(m, kFocalBaseline, z, 0.0, 0.5);
    const double pixel = z * z / kFocalBaseline;
    EXPECT_NEAR(s.mean, z, 0.05 * pixel) << z;
    EXPECT_NEAR(s.sigma, predicted, 0.2 * predicted) << z;
  }
}

TEST(LaserLine, SpeckleHasItsMeanAndContrast) {
  NoiseModel m = profiler();
  m.line_contrast = 0.6;
  const double grain = speckle_grain_m(m);
  const LineStatistics s = statistics(20000, [&](int i) {
    return speckle_factor(m, 3, Vec3d((i + 0.5) * grain, 0.0, 0.0), Vec3d::UnitZ());
  });
  EXPECT_NEAR(s.mean, 1.0, 0.03);
  EXPECT_NEAR(s.sigma, 0.6, 0.03);
}

TEST(LaserLine, SpeckleIsFrozenOnTheSurface) {
  NoiseModel m = profiler();
  m.line_contrast = 1.0;
  const double grain = speckle_grain_m(m);
  const Vec3d p(10.3 * grain, 5.5 * grain, -7.5 * grain), d(0.3 * m.line_aperture, 0.0, 1.0);
  const double here = speckle_factor(m, 3, p, d);
  EXPECT_EQ(speckle_factor(m, 3, p + Vec3d(0.3 * grain, 0.0, 0.0), d), here);
  EXPECT_EQ(speckle_factor(m, 3, p, d + Vec3d(0.2 * m.line_aperture, 0.0, 0.0)), here);
  EXPECT_NE(speckle_factor(m, 3, p + Vec3d(grain, 0.0, 0.0), d), here);
  EXPECT_NE(speckle_factor(m, 3, p, d + Vec3d(m.line_aperture, 0.0, 0.0)), here);
  EXPECT_NE(speckle_factor(m, 4, p, d), here);
}

TEST(LaserLine, SpeckleGivesThePredictedSigma) {
  NoiseModel m = profiler();
  m.line_contrast = 1.0;
  m.line_exposure = 1e6;  // electrons do not matter
  m.line_full_well = 0.0;
  const double z = 0.3, grain = speckle_grain_m(m);
  auto spots = flat(m, z);
  const auto clean = spots;
  const LineStatistics s = statistics(4000, [&](int i) {
    for (std::size_t k = 0; k < spots.size(); ++k) {
      const Vec3d p((double(k) + 0.5) * grain, (i + 0.5) * grain, 0.0);
      spots[k].light = clean[k].light * speckle_factor(m, 11, p, Vec3d::UnitZ());
    }
    return *measure_line(m, kFocalBaseline, spots, hash_key(1, std::uint64_t(i)));
  });
  const double predicted = laser_line_sigma_m(m, kFocalBaseline, z, 0.0, 0.5);
  EXPECT_NEAR(s.sigma, predicted, 0.25 * predicted);
}

TEST(LaserLine, HalfALineCurlsTowardsTheHalfThatIsThere) {
  const NoiseModel m = profiler();
  const double z = 0.3;
  auto near_half = flat(m, z);
  std::erase_if(near_half, [](const LineSpot& s) { return s.beside_m > 0.0; });
  // The mean of half a Gaussian is sigma * sqrt(2 / pi) beside the middle.
  const double beside = 60e-6 / 2.3548 * std::sqrt(2.0 / 3.14159265);
  const double expected = -z * beside / 0.12;
  const LineStatistics s = statistics(1000, [&](int i) {
    return *measure_line(m, kFocalBaseline, near_half, hash_key(5, std::uint64_t(i))) - z;
  });
  EXPECT_NEAR(s.mean, expected, 0.15 * std::abs(expected));
}

TEST(LaserLine, DarkSurfaceHasNoPeak) {
  const NoiseModel m = profiler();
  EXPECT_FALSE(measure_line(m, kFocalBaseline, flat(m, 0.3, 0.001), 1));
  EXPECT_FALSE(measure_line(m, kFocalBaseline, {}, 1));
  EXPECT_TRUE(std::isnan(laser_line_sigma_m(m, kFocalBaseline, 0.3, 0.0, 0.001)));
}

TEST(LaserLine, ALineWithoutWidthHasOneStrip) {
  EXPECT_EQ(line_strips_m(NoiseModel()), std::vector<double>{0.0});
  EXPECT_EQ(line_profile(NoiseModel(), 0.0), 1.0);
  const std::vector<double> strips = line_strips_m(profiler());
  EXPECT_GE(strips.size(), 9u);
  EXPECT_LE(strips.size(), 64u);
  for (std::size_t i = 0; i < strips.size(); ++i)
    EXPECT_NEAR(strips[i], -strips[strips.size() - 1 - i], 1e-15);
}

}  // namespace
}  // namespace turnscan
