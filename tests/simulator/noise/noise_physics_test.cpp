// Kinect v2 and laser line, from rays to depth.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <tests/simulator/noise/noise_scenes.hpp>
#include "tests/support/sanitizers.hpp"

namespace turnscan {
namespace {

using namespace test;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

ScannerModel kinect_v2_scanner() {
  ScannerModel m = camera(150, 120, 365.5);
  m.near_m = 0.5;
  m.far_m = 4.5;
  m.emitter_m = Vec3d(0.08, 0.0, 0.0);
  m.noise.footprint_px = 1.0;
  m.noise.physics = SensorPhysics::kKinectV2;
  return m;
}

/// Of measured minus exact, without the two outermost pixels.
Spread error_of(const Bench& bench, const MeasuredGrid& out) {
  const auto w = std::size_t(out.rect.width()), h = std::size_t(out.rect.height());
  return spread_of(out.z.size(), [&](std::size_t i) {
    const std::size_t x = i % w, y = i / w;
    const bool inside = x > 1 && y > 1 && x + 2 < w && y + 2 < h;
    return inside && out.z[i] > 0.0f ? double(out.z[i]) - bench.exact().z[i] : kMissing;
  });
}

TEST(KinectV2Sensor, AxialSigmaAtEightyCentimetresIsThePublishedOne) {
  const Bench bench(kinect_v2_scanner(), {wall(0.8)});
  const Spread s = error_of(bench, bench.measure(noise_of("physics")));
  EXPECT_GT(s.n, 16000);
  EXPECT_NEAR(s.sigma, 1.3e-3, 0.15 * 1.3e-3);
  EXPECT_NEAR(s.mean, 0.0, 0.2e-3);
}

TEST(KinectV2Sensor, DepthIsUnbiasedOverDistanceAndAngle) {
  for (const double z : {0.6, 1.5, 3.0}) {
    for (const double tilt : {0.0, 0.5, 1.0}) {
      const Bench bench(kinect_v2_scanner(), {wall(z, tilt)});
      const Spread s = error_of(bench, bench.measure(noise_of("physics")));
      EXPECT_GT(s.n, 8000) << z << " " << tilt;
      // A slanted wall bends within the filter's 3 x 3 pixels.
      EXPECT_NEAR(s.mean, 0.0, tilt == 0.0 ? 0.3e-3 : 1.5e-3) << z << " " << tilt;
    }
  }
}

/// With the preset's numbers at grazing incidence.
ScannerModel kinect_v2_preset() {
  ScannerModel m = kinect_v2_scanner();
  m.max_incidence_rad = 85.0 * std::numbers::pi / 180.0;
  m.noise.axial_constant_m = 1.2916667e-3;
  m.noise.axial_quadratic_per_m = 0.0003;
  m.noise.axial_quadratic_at_m = 0.83333333;
  m.noise.axial_grazing = 0.0001;
  m.noise.axial_grazing_power = 1.5;
  return m;
}

/// Of a slanted wall with its middle straight ahead: residuals as a share of the published sigma
/// where the incidence is near the one asked for, and how many pixels gave none.
struct Slanted {
  Spread of_published;
  double lost = 0.0;
};

Slanted slanted(double z, double degrees) {
  const double tilt = degrees * std::numbers::pi / 180.0;
  const Bench bench(kinect_v2_preset(), {wall(z, tilt)});
  Slanted out;
  int asked = 0, lost = 0;
  double sum = 0.0, squares = 0.0;
  for (std::uint32_t frame = 0; frame < 6; ++frame) {
    const MeasuredGrid measured = bench.measure(noise_of("physics"), frame);
    const Spread s = spread_of(measured.z.size(), [&](std::size_t i) {
      if (!bench.exact().counts(i)) return kMissing;
      const double incidence = bench.incidence(i), d = bench.exact().z[i];
      if (std::abs(incidence - tilt) > 0.01) return kMissing;
      ++asked;
      lost += measured.z[i] > 0.0f ? 0 : 1;
      if (!(measured.z[i] > 0.0f)) return kMissing;
      return (measured.z[i] - d) / axial_sigma_m(bench.model().noise, d, incidence);
    });
    sum += s.mean * s.n;
    squares += (s.sigma * s.sigma + s.mean * s.mean) * s.n;
    out.of_published.n += s.n;
  }
  out.of_published.mean = sum / out.of_published.n;
  out.of_published.sigma =
      std::sqrt(squares / out.of_published.n - out.of_published.mean * out.of_published.mean);
  out.lost = double(lost) / asked;
  return out;
}

TEST(KinectV2Sensor, AxialSigmaAtGrazingIncidenceIsThePublishedOne) {
  if (testing::kSanitized) GTEST_SKIP() << "the others run the same code";
  // Fankhauser et al. 2015: + 0.1 mm z^1.5 t^2 / (pi/2 - t)^2.
  const auto noise = SensorNoise::create(kinect_v2_preset(), noise_of("physics"), 1, 0).value();
  for (const double z : {0.8, 1.2, 2.0, 3.0}) {
    for (const double degrees : {30.0, 60.0, 70.0, 75.0, 80.0}) {
      if (z > 2.5 && degrees > 75.0) continue;  // 36 mm: the driver takes out some
      const Slanted s = slanted(z, degrees);
      EXPECT_GT(s.of_published.n, 5000);
      EXPECT_NEAR(s.of_published.sigma, 1.0, 0.15) << z << " m, " << degrees << " deg";
      EXPECT_NEAR(s.of_published.mean, 0.0, 0.06) << z << " m, " << degrees << " deg";
      const double incidence = degrees * std::numbers::pi / 180.0;
      const double published = axial_sigma_m(kinect_v2_preset().noise, z, incidence);
      EXPECT_NEAR(noise.predicted_sigma_m(z, incidence) / published, 1.0, 0.1);
    }
  }
}

TEST(KinectV2Sensor, DriverTakesOutWhatIsGrazingAndFar) {
  EXPECT_EQ(slanted(1.2, 75.0).lost, 0.0);
  EXPECT_GT(slanted(3.0, 80.0).lost, 0.005);
  EXPECT_GT(slanted(3.0, 83.0).lost, 4.0 * slanted(3.0, 80.0).lost);
}

TEST(KinectV2Sensor, PredictedSigmaIsTheMeasuredOneForDarkAndSlantedWallsToo) {
  const auto noise = SensorNoise::create(kinect_v2_scanner(), noise_of("physics"), 1, 0).value();
  for (const double z : {0.8, 1.5, 3.0}) {
    for (const double tilt : {0.0, 0.9}) {
      for (const double albedo : {0.8, 0.4}) {
        Bench bench(kinect_v2_scanner(), {wall(z, tilt)});
        bench.set_albedo([albedo](auto, auto, auto) { return float(albedo); });
        const MeasuredGrid out = bench.measure(noise_of("physics"));
        const auto w = std::size_t(out.rect.width()), h = std::size_t(out.rect.height());
        const Spread s = spread_of(out.z.size(), [&](std::size_t i) {
          const std::size_t x = i % w, y = i / w;
          if (x < 2 || y < 2 || x + 2 >= w || y + 2 >= h || !(out.z[i] > 0.0f)) return kMissing;
          const double d = bench.exact().z[i];
          return (out.z[i] - d) / noise.predicted_sigma_m(d, bench.incidence(i), albedo);
        });
        EXPECT_NEAR(s.sigma, 1.0, 0.15) << z << " " << tilt << " " << albedo;
      }
    }
  }
  EXPECT_TRUE(std::isnan(noise.predicted_sigma_m(3.0, 0.0, 0.01)));
}

TEST(KinectV2Sensor, FlyingPixelsLieOnTheirLinesOfSightBetweenTheSurfaces) {
  const Bench bench(kinect_v2_scanner(), {half_wall(1.0, 0.0, 0.03), wall(1.07)});
  const MeasuredGrid out = bench.measure(noise_of("physics"));
  int flying = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    if (!(out.z[i] > 0.0f)) continue;
    EXPECT_GT(out.z[i], 0.99f);
    EXPECT_LT(out.z[i], 1.08f);
    const Vec3d d = bench.direction(i);
    const double off = std::abs(d.x() - 0.03 * d.y()) * 365.5;
    const bool between = out.z[i] > 1.015f && out.z[i] < 1.055f;
    flying += between;
    EXPECT_LE(!between ? 0.0 : off, 2.1);  // half a pixel, and one that the filter adds
  }
  EXPECT_GT(flying, 60);
}

TEST(KinectV2Sensor, DriverRejectsMostFlyingPixelsOfLargeSteps) {
  const Bench bench(kinect_v2_scanner(), {half_wall(1.0, 0.0, 0.03), wall(1.4)});
  const MeasuredGrid out = bench.measure(noise_of("physics"));
  int between = 0, rejected = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    rejected += out.miss[i] == Miss::kRejected;
    between += out.z[i] > 1.06f && out.z[i] < 1.36f;
    EXPECT_EQ(out.z[i] > 0.0f, out.miss[i] == Miss::kNone);
  }
  // Those survive that see no full pixel of one of the surfaces beside them.
  EXPECT_GT(rejected, 40);
  EXPECT_LT(between, rejected / 3);
}

TEST(KinectV2Sensor, ShadowOfTheLampsKeepsTheFarWallOutOfThePixelsAlongTheEdge) {
  ScannerModel m = kinect_v2_scanner();
  m.emitter_m = Vec3d(-0.08, 0.0, 0.0);
  const Bench bench(m, {half_wall(1.0, 0.0, 0.03), wall(1.4)});
  const MeasuredGrid out = bench.measure(noise_of("physics"));
  int between = 0, shadow = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    between += out.z[i] > 1.02f && out.z[i] < 1.36f;
    shadow += out.miss[i] == Miss::kEmitterBlocked;
  }
  // Its width is b * (1 / near - 1 / far) * f = 8.4 pixels.
  EXPECT_NEAR(shadow, 8.4 * 120, 2.0 * 120);
  EXPECT_LE(between, 2);
}

TEST(KinectV2Sensor, EmptySkyGivesAlmostNoDepth) {
  // A small thing in the middle of a large rectangle: what is around it returns nothing.
  TriangleMesh far = wall(0.9, 0.0, 0.01);
  for (Vec3f& v : far.vertices) v += Vec3f(0.15f, 0.12f, 0.0f);
  const Bench bench(kinect_v2_scanner(), {wall(1.0, 0.0, 0.02), far});
  int false_returns = 0;
  std::size_t sky = 0;
  for (std::uint32_t frame = 0; frame < 20; ++frame) {
    const MeasuredGrid out = bench.measure(noise_of("physics"), frame);
    for (std::size_t i = 0; i < out.z.size(); ++i)
      false_returns += out.z[i] > 0.0f && (out.z[i] < 0.85f || out.z[i] > 1.05f);
    sky += out.z.size();
  }
  // Once in a while noise agrees with itself.
  EXPECT_LT(false_returns, 1e-4 * double(sky));
}

TEST(KinectV2Sensor, DarkSurfaceIsTooDark) {
  Bench bench(kinect_v2_scanner(), {wall(3.0)});
  bench.set_albedo([](auto, auto, auto) { return 0.003f; });
  const MeasuredGrid out = bench.measure(noise_of("physics"));
  int dark = 0;
  for (const Miss m : out.miss) dark += m == Miss::kTooDark;
  EXPECT_GT(dark, 150 * 120 * 9 / 10);
}

TEST(KinectV2Sensor, SameSeedGivesTheSameBytes) {
  const Bench bench(kinect_v2_scanner(), {half_wall(1.0, 0.0, 0.03), wall(1.2)});
  const MeasuredGrid a = bench.measure(noise_of("physics"), 4);
  EXPECT_EQ(bench.measure(noise_of("physics"), 4).z, a.z);
  EXPECT_NE(bench.measure(noise_of("physics"), 5).z, a.z);
  EXPECT_NE(bench.measure(noise_of("physics"), 4, 2).z, a.z);
}

TEST(KinectV2Sensor, PixelsWithoutALineOfSightStayOutOfView) {
  // A lens so strong that the corners of the image belong to no ray.
  ScannerModel m = kinect_v2_scanner();
  m.camera.fx = m.camera.fy = 60.0;
  m.camera.distortion = {-0.25, 0.0, 0.0, 0.0, 0.0};
  m.noise.lateral_m = 0.0016;
  const Bench bench(m, {half_wall(0.8, 0.0, 0.1), wall(1.2)});
  for (const char* kind : {"model", "physics"}) {
    const MeasuredGrid out = bench.measure(noise_of(kind));
    int outside = 0;
    for (std::size_t i = 0; i < out.z.size(); ++i) {
      ASSERT_TRUE(std::isfinite(out.z[i]));
      EXPECT_EQ(out.z[i] > 0.0f, out.miss[i] == Miss::kNone);
      if (bench.exact().miss[i] != Miss::kOutOfView) continue;
      EXPECT_EQ(out.miss[i], Miss::kOutOfView);
      ++outside;
    }
    EXPECT_GT(outside, 100);
  }
}

/// 12 cm of line at 0.3 m, camera 12 cm beside the sheet of light.
ScannerModel profiler() {
  ScannerModel m = camera(1, 400, 1000.0);
  m.kind = ScannerKind::kLine;
  m.sensing = Sensing::kLaserLine;
  m.receiver_m = Vec3d(0.12, 0.0, 0.0);
  m.camera.cx = 0.0;
  m.near_m = 0.2;
  m.far_m = 0.5;
  m.noise.physics = SensorPhysics::kLaserLine;
  m.noise.line_width_m = 60e-6;
  m.noise.line_wavelength_m = 405e-9;
  m.noise.line_aperture = 0.02;
  m.noise.line_contrast = 1.0;
  m.noise.line_focal_px = 6000.0;
  m.noise.line_exposure = 3000.0;
  m.noise.line_read_noise = 10.0;
  m.noise.line_full_well = 20000.0;
  m.noise.line_threshold = 100.0;
  return m;
}

TEST(LaserLineSensor, SigmaIsThePredictedOne) {
  const Bench bench(profiler(), {wall(0.3, 0.0, 0.3)});
  const MeasuredGrid out = bench.measure(noise_of("physics"));
  const Spread s = spread_of(out.z.size(), [&](std::size_t i) {
    return out.z[i] > 0.0f ? double(out.z[i]) - bench.exact().z[i] : kMissing;
  });
  const auto noise = SensorNoise::create(bench.model(), noise_of("physics"), 1, 0).value();
  const double predicted = noise.predicted_sigma_m(0.3, 0.0);
  EXPECT_GT(s.n, 390);
  EXPECT_NEAR(s.sigma, predicted, 0.3 * predicted);
  EXPECT_NEAR(s.mean, 0.0, 4.5 * s.sigma / std::sqrt(double(s.n)));
}

TEST(LaserLineSensor, AveragingFramesDoesNotReduceSpeckle) {
  const Bench bench(profiler(), {wall(0.3, 0.0, 0.3)});
  const auto deviation = [&](std::uint32_t first, std::uint32_t count) {
    std::vector<double> mean(bench.exact().size(), 0.0);
    for (std::uint32_t f = first; f < first + count; ++f) {
      const MeasuredGrid out = bench.measure(noise_of("physics"), f);
      for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] += (out.z[i] - bench.exact().z[i]) / count;
    }
    return spread_of(mean.size(), [&](std::size_t i) { return mean[i]; }).sigma;
  };
  EXPECT_GT(deviation(0, 16), 0.9 * deviation(0, 1));
}

TEST(LaserLineSensor, DepthCurlsWhereOnlyPartOfTheLineLands) {
  // The edge runs along the line: only what lies on its left lands.
  ScannerModel m = profiler();
  m.noise.line_contrast = 0.0;
  const Bench bench(m, {half_wall(0.3, 5e-6)});
  const MeasuredGrid out = bench.measure(noise_of("physics"));
  const Spread s = spread_of(out.z.size(), [&](std::size_t i) {
    return out.z[i] > 0.0f ? double(out.z[i]) - 0.3 : kMissing;
  });
  ASSERT_GT(s.n, 390);
  // The light's middle lies left of the sheet, away from the camera: seen nearer.
  EXPECT_LT(s.mean, -20e-6);
  EXPECT_GT(s.mean, -60e-6);
}

TEST(LaserLineSensor, BlackSurfaceHasNoPeak) {
  Bench bench(profiler(), {wall(0.3, 0.0, 0.3)});
  bench.set_albedo([](auto, auto, auto) { return 0.002f; });
  const MeasuredGrid out = bench.measure(noise_of("physics"));
  for (std::size_t i = 0; i < out.z.size(); ++i)
    if (bench.exact().counts(i)) {
      EXPECT_EQ(out.miss[i], Miss::kTooDark);
    }
}

}  // namespace
}  // namespace turnscan
