// Errors that are the same in every frame, or fade.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tests/simulator/noise/noise_scenes.hpp>
#include <tests/simulator/scans.hpp>

namespace turnscan {
namespace {

using namespace test;

ScannerModel straight_time_of_flight() {
  ScannerModel m = camera(9, 9, 365.5);
  m.sensing = Sensing::kTimeOfFlight;
  return m;
}

/// Error straight ahead, of a wall.
double error_at(const ScannerModel& model, const NoiseOptions& options, double z) {
  const Bench bench(model, {wall(z)});
  const std::size_t i = bench.exact().index(4, 4);
  return bench.measure(options).z[i] - double(bench.exact().z[i]);
}

TEST(Wiggling, RisesAndFallsWithTheRange) {
  NoiseOptions options;
  options.wiggling_m = 0.005;
  options.wiggling_period_m = 0.4;
  double least = 1.0, most = -1.0;
  for (double z = 0.6; z < 2.0; z += 0.0131) {
    const double error = error_at(straight_time_of_flight(), options, z);
    EXPECT_NEAR(error, 0.005 * std::sin(2.0 * std::numbers::pi * z / 0.4), 1e-6) << z;
    least = std::min(least, error);
    most = std::max(most, error);
  }
  EXPECT_NEAR(most, 0.005, 1e-4);
  EXPECT_NEAR(least, -0.005, 1e-4);
}

TEST(Wiggling, IsAlongTheLineOfSight) {
  NoiseOptions options;
  options.wiggling_m = 0.005;
  options.wiggling_period_m = 0.4;
  ScannerModel model = straight_time_of_flight();
  model.camera.fx = model.camera.fy = 6.0;
  const Bench bench(model, {wall(1.0)});
  const MeasuredGrid out = bench.measure(options);
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    const double secant = bench.direction(i).norm(), z = bench.exact().z[i];
    const double range = z * secant;
    EXPECT_NEAR(out.z[i] * secant - range, 0.005 * std::sin(2.0 * std::numbers::pi * range / 0.4),
                2e-6);
  }
}

TEST(Wiggling, IsOfTimeOfFlightOnly) {
  NoiseOptions options;
  options.wiggling_m = 0.005;
  ScannerModel model = straight_time_of_flight();
  for (const Sensing sensing : {Sensing::kIdeal, Sensing::kStructuredLight, Sensing::kStereo}) {
    model.sensing = sensing;
    EXPECT_EQ(error_at(model, options, 1.1), 0.0);
  }
}

/// Error of the phase of a correlation sampled at n phases, whose shape is a triangle: light and
/// sensor are switched on and off. In turns.
double triangle_error(double turns, int n) {
  double re = 0.0, im = 0.0;
  for (int k = 0; k < n; ++k) {
    const double at = turns - double(k) / n;
    const double triangle = 4.0 * std::abs(at - std::floor(at + 0.5)) - 1.0;
    re -= triangle * std::cos(2.0 * std::numbers::pi * k / n);
    im -= triangle * std::sin(2.0 * std::numbers::pi * k / n);
  }
  const double error = std::atan2(im, re) / (2.0 * std::numbers::pi) - turns;
  return error - std::round(error);
}

TEST(Wiggling, HasTheShapeAndThePeriodOfAliasedHarmonics) {
  // Whyte 2020, four images at 50 MHz, light in square waves: 58 mm from the least to the greatest
  // error over the 2998 mm of a turn. Nearly all of it is a sine of four periods, of 0.75 m each.
  constexpr int kSteps = 3000;
  double low = 1.0, high = -1.0, sine = 0.0, power = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double turns = double(i) / kSteps, error = triangle_error(turns, 4);
    low = std::min(low, error);
    high = std::max(high, error);
    sine += 2.0 * error * std::sin(2.0 * std::numbers::pi * 4.0 * turns) / kSteps;
    power += error * error / kSteps;
  }
  EXPECT_NEAR((high - low) * 2998.0, 58.0, 0.2 * 58.0);
  EXPECT_GT(0.5 * sine * sine / power, 0.99);
  EXPECT_NEAR(4.0 * MeasureOptions().wiggling_period_m, 2.998, 0.01);
}

TEST(WarmUp, FadesAsThePublishedTimeSays) {
  // Toelgyessy et al. 2021: an Azure Kinect is steady after 40 to 50 minutes.
  VirtualScanOptions o = plain_scan();
  o.measure.noise = "none";
  o.motion.frames = 46;
  o.motion.fps = 1.0 / 60.0;
  o.motion.turns = 0.0;
  const VirtualScan warm = scan_of({}, o);
  o.measure.warm_up_m = 0.01;
  const VirtualScan cold = scan_of({}, o);
  const auto error = [&](std::size_t i) {
    const MeasuredGrid a = cold.samples(i)->measured, b = warm.samples(i)->measured;
    const auto seen = std::find_if(b.z.begin(), b.z.end(), [](float z) { return z > 0.0f; });
    const auto k = std::size_t(seen - b.z.begin());
    return double(a.z[k]) - double(b.z[k]);
  };
  EXPECT_NEAR(error(0), 0.01, 1e-6);
  EXPECT_NEAR(error(15), 0.01 * std::exp(-1.0), 1e-6);
  EXPECT_LT(error(45), 0.05 * 0.01);
  EXPECT_GT(error(40), 0.05 * 0.01);
}

TEST(SystematicOptions, RefuseValuesOutsideTheirRange) {
  const auto refused = [](double MeasureOptions::*field, double value, const std::string& name) {
    MeasureOptions o;
    o.*field = value;
    const auto checked = describe(o).check();
    ASSERT_FALSE(checked) << name;
    EXPECT_EQ(checked.error().message.find(name + " = "), 0u) << checked.error().message;
  };
  for (const double bad : {-2.0, std::numeric_limits<double>::quiet_NaN()}) {
    refused(&MeasureOptions::wiggling_m, bad, "wiggling");
    refused(&MeasureOptions::wiggling_period_m, bad, "wiggling-period");
    refused(&MeasureOptions::warm_up_m, bad, "warm-up");
    refused(&MeasureOptions::warm_up_time_s, bad, "warm-up-time");
  }
}

}  // namespace
}  // namespace turnscan
