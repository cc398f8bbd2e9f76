// The whole way from exact samples to measured ones, on walls.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tests/simulator/noise/noise_scenes.hpp>
#include <tuple>
#include <turnscan/core/parallel.hpp>
#include <turnscan/sensors/scanner_file.hpp>

namespace turnscan {
namespace {

using namespace test;

constexpr double kNoDepth = std::numeric_limits<double>::quiet_NaN();

ScannerModel fankhauser() {
  ScannerModel m = camera(140, 110, 365.5);
  m.noise.axial_constant_m = 0.0015;
  m.noise.axial_linear = -0.0005;
  m.noise.axial_quadratic_per_m = 0.0003;
  m.noise.axial_grazing = 0.0001;
  m.noise.axial_grazing_power = 1.5;
  return m;
}

ScannerModel nguyen() {
  ScannerModel m = camera(140, 110, 585.0);
  m.emitter_m = Vec3d(0.075, 0.0, 0.0);
  m.noise.axial_constant_m = 0.0012;
  m.noise.axial_quadratic_per_m = 0.0019;
  m.noise.axial_quadratic_at_m = 0.4;
  m.noise.axial_grazing = 0.0001;
  m.noise.axial_grazing_power = -0.5;
  m.noise.axial_grazing_from_rad = std::numbers::pi / 3;
  m.noise.disparity_step_px = 0.125;
  return m;
}

TEST(SensorNoise, WithoutNoiseEverySampleIsExact) {
  const Bench bench(fankhauser(), {wall(1.0, 0.5)});
  const MeasuredGrid out = bench.measure(NoiseOptions());
  EXPECT_EQ(out.z, bench.exact().z);
  EXPECT_EQ(out.miss, bench.exact().miss);
  EXPECT_EQ(out.rect, bench.exact().rect);
}

TEST(SensorNoise, GaussianHasItsMeanAndSigmaAtEveryDistanceAndAngle) {
  for (const double z : {0.6, 2.5}) {
    for (const double tilt : {0.0, 1.2}) {
      const Bench bench(fankhauser(), {wall(z, tilt)});
      const MeasuredGrid out = bench.measure(noise_of("gaussian:1.5mm"));
      const Spread s = spread_of(out.z.size(), [&](std::size_t i) {
        return bench.exact().counts(i) ? double(out.z[i]) - bench.exact().z[i] : kNoDepth;
      });
      EXPECT_EQ(s.n, 140 * 110);
      EXPECT_NEAR(s.mean, 0.0, 4.5 * 1.5e-3 / std::sqrt(double(s.n)));
      EXPECT_NEAR(s.sigma, 1.5e-3, 4.5 * 1.5e-3 / std::sqrt(2.0 * s.n));
    }
  }
}

TEST(SensorNoise, ModelFollowsFankhauserOverDistanceAndAngle) {
  for (const double z : {0.6, 0.8, 1.5, 3.0}) {
    for (const double tilt : {0.0, 0.5, 1.0, 1.3}) {
      const Bench bench(fankhauser(), {wall(z, tilt)});
      const MeasuredGrid out = bench.measure(noise_of("model"));
      const Spread s = spread_of(out.z.size(), [&](std::size_t i) {
        if (!bench.exact().counts(i)) return kNoDepth;
        const double d = bench.exact().z[i], t = bench.incidence(i);
        const double mm = 1.5 - 0.5 * d + 0.3 * d * d +
                          0.1 * std::pow(d, 1.5) * t * t /
                              ((std::numbers::pi / 2 - t) * (std::numbers::pi / 2 - t));
        return (out.z[i] - d) / (1e-3 * mm);
      });
      ASSERT_GT(s.n, 3000);
      EXPECT_NEAR(s.mean, 0.0, 4.5 / std::sqrt(double(s.n))) << z << " " << tilt;
      EXPECT_NEAR(s.sigma, 1.0, 4.5 / std::sqrt(2.0 * s.n) + 0.002) << z << " " << tilt;
    }
  }
}

TEST(SensorNoise, ModelFollowsNguyenStepsIncluded) {
  const double focal_baseline = 585.0 * 0.075;
  for (const double z : {0.7, 1.2, 3.0}) {
    for (const double tilt : {0.0, 0.7, 1.2}) {
      const Bench bench(nguyen(), {wall(z, tilt)});
      const MeasuredGrid out = bench.measure(noise_of("model"));
      const Spread s = spread_of(out.z.size(), [&](std::size_t i) {
        if (!(out.z[i] > 0.0f)) return kNoDepth;
        const double steps = focal_baseline / double(out.z[i]) * 8.0;
        EXPECT_NEAR(steps, std::round(steps), 1e-3);
        const double d = bench.exact().z[i], t = bench.incidence(i);
        double sigma = 0.0012 + 0.0019 * (d - 0.4) * (d - 0.4);
        if (t >= std::numbers::pi / 3)
          sigma += 0.0001 / std::sqrt(d) * t * t /
                   ((std::numbers::pi / 2 - t) * (std::numbers::pi / 2 - t));
        return (out.z[i] - d) / sigma;
      });
      ASSERT_GT(s.n, 3000);
      // The steps are not Gaussian, and frontal all pixels share them.
      EXPECT_NEAR(s.mean, 0.0, 0.05) << z << " " << tilt;
      EXPECT_NEAR(s.sigma, 1.0, 0.04) << z << " " << tilt;
    }
  }
}

TEST(SensorNoise, StereoErrorGrowsWithTheSquareOfDistance) {
  ScannerModel m = camera(140, 110, 686.0);
  m.emitter_m = Vec3d(0.05, 0.0, 0.0);
  m.noise.disparity_sigma_px = 0.08;
  for (const double z : {0.5, 1.0, 2.0}) {
    const Bench bench(m, {wall(z)});
    const MeasuredGrid out = bench.measure(noise_of("model"));
    const Spread s =
        spread_of(out.z.size(), [&](std::size_t i) { return out.z[i] - bench.exact().z[i]; });
    const double expected = z * z * 0.08 / (686.0 * 0.05);
    EXPECT_NEAR(s.sigma, expected, 0.03 * expected) << z;
  }
}

TEST(SensorNoise, BiasShiftsEveryDepth) {
  ScannerModel m = camera(60, 50, 300.0);
  m.noise.bias_m = -0.018;
  const Bench bench(m, {wall(1.0)});
  const MeasuredGrid out = bench.measure(noise_of("model"));
  for (std::size_t i = 0; i < out.z.size(); ++i)
    if (bench.exact().counts(i)) {
      EXPECT_NEAR(out.z[i], bench.exact().z[i] - 0.018, 1e-6);
    }
}

TEST(SensorNoise, GrazingReturnsGetLostMoreAndMore) {
  ScannerModel m = camera(140, 110, 1000.0);
  m.noise.drop_from_rad = 1.0;
  m.noise.drop_to_rad = 1.4;
  for (const double tilt : {0.6, 1.1, 1.2, 1.3}) {
    const Bench bench(m, {wall(2.0, tilt)});
    const MeasuredGrid out = bench.measure(noise_of("model"));
    double expected = 0.0;
    int lost = 0, n = 0;
    for (std::size_t i = 0; i < out.z.size(); ++i) {
      if (!bench.exact().counts(i)) continue;
      ++n;
      expected += std::clamp((bench.incidence(i) - 1.0) / 0.4, 0.0, 1.0);
      lost += out.miss[i] == Miss::kGrazing;
      EXPECT_EQ(out.z[i] > 0.0f, out.miss[i] == Miss::kNone);
    }
    EXPECT_NEAR(lost, expected, 4.5 * std::sqrt(0.25 * n) + 1.0) << tilt;
  }
}

TEST(SensorNoise, DarkSurfacesReturnNothing) {
  ScannerModel m = camera(60, 50, 300.0);
  m.noise.dark_signal_per_m2 = 0.1;
  Bench bench(m, {wall(1.0)});
  bench.set_albedo([](auto, auto, auto) { return 0.05f; });
  const MeasuredGrid dark = bench.measure(noise_of("model"));
  bench.set_albedo([](auto, auto, auto) { return 0.2f; });
  const MeasuredGrid grey = bench.measure(noise_of("model"));
  for (std::size_t i = 0; i < dark.z.size(); ++i) {
    if (!bench.exact().counts(i)) continue;
    EXPECT_EQ(dark.miss[i], Miss::kTooDark);
    EXPECT_EQ(dark.z[i], 0.0f);
    EXPECT_EQ(grey.miss[i], Miss::kNone);
  }
}

TEST(SensorNoise, DarkLimitIsSoftWithJitter) {
  ScannerModel m = camera(100, 100, 1000.0);
  m.noise.dark_signal_per_m2 = 0.1;
  m.noise.dark_jitter = 0.1;
  Bench bench(m, {wall(1.0)});
  bench.set_albedo([](auto, auto, auto) { return 0.1f; });
  const MeasuredGrid out = bench.measure(noise_of("model"));
  const auto lost = std::count(out.miss.begin(), out.miss.end(), Miss::kTooDark);
  EXPECT_NEAR(double(lost), 5000.0, 500.0);
}

/// Near wall on the left, its edge a little off upright so that it crosses pixels anyhow.
Bench step(const ScannerModel& m, double near, double far) {
  return {m, {half_wall(near, 0.0, 0.03), wall(far)}};
}

TEST(SensorNoise, MixedPixelsLieBetweenTheSurfacesOnTheirLineOfSight) {
  ScannerModel m = camera(80, 120, 400.0);
  m.noise.footprint_px = 1.0;
  const Bench bench = step(m, 1.0, 1.2);
  const MeasuredGrid out = bench.measure(noise_of("model"));
  int between = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    ASSERT_GT(out.z[i], 1.0f - 1e-4f);
    ASSERT_LT(out.z[i], 1.2f + 1e-4f);
    // Edge at x = 0.03 y at depth 1: pixels that it does not cross see one wall.
    const Vec3d d = bench.direction(i);
    const double off = (d.x() - 0.03 * d.y()) * 400.0;
    const bool flying = out.z[i] > 1.001f && out.z[i] < 1.199f;
    between += flying;
    EXPECT_LE(!flying ? 0.0 : std::abs(off), 0.53);
  }
  // The edge crosses each row in one or two pixels.
  EXPECT_GT(between, 90);
  EXPECT_LT(between, 240);
}

TEST(SensorNoise, MixedPixelFarFromBothIsRejectedOnRequest) {
  ScannerModel m = camera(80, 120, 400.0);
  m.noise.footprint_px = 1.0;
  m.noise.mixed_rejection_m = 0.04;
  const Bench bench = step(m, 1.0, 1.2);
  const MeasuredGrid out = bench.measure(noise_of("model"));
  int rejected = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    rejected += out.miss[i] == Miss::kRejected;
    if (out.miss[i] == Miss::kRejected) {
      EXPECT_EQ(out.z[i], 0.0f);
    } else {
      EXPECT_FALSE(out.z[i] > 1.041f && out.z[i] < 1.159f) << out.z[i];
    }
  }
  EXPECT_GT(rejected, 30);
}

TEST(SensorNoise, LateralNoiseRoughensEdgesByItsSigma) {
  ScannerModel m = camera(80, 400, 400.0);
  m.noise.lateral_px = 0.8;
  const Bench bench(m, {half_wall(1.0, 0.0, 0.03), wall(1.5)});
  const MeasuredGrid out = bench.measure(noise_of("model"));
  double expected[2] = {}, seen[2] = {};
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    // A pixel sees one wall or the other, nothing between.
    ASSERT_TRUE(std::abs(out.z[i] - 1.0f) < 1e-3f || std::abs(out.z[i] - 1.5f) < 1e-3f);
    const Vec3d d = bench.direction(i);
    const double off = (d.x() - 0.03 * d.y()) * 400.0;
    // The chance that the far wall is seen is that of a normal draw to pass the edge.
    const double chance = 0.5 * std::erfc(-off / 0.8 / std::numbers::sqrt2);
    const std::size_t side = off < 0.0 ? 0 : 1;
    expected[side] += side == 0 ? chance : 1.0 - chance;
    seen[side] += (out.z[i] > 1.25f) == (side == 0) ? 1.0 : 0.0;
  }
  for (int side = 0; side < 2; ++side)
    EXPECT_NEAR(seen[side], expected[side], 4.5 * std::sqrt(expected[side]) + 2.0) << side;
}

TEST(SensorNoise, LateralNoiseDoesNotRoughenSlopes) {
  // Within reach of an edge, on a wall turned away by 60 degrees.
  ScannerModel m = camera(80, 60, 400.0);
  m.noise.lateral_px = 0.8;
  TriangleMesh slope = wall(1.0, 1.05, 0.05);
  const Bench bench(m, {slope});
  const MeasuredGrid out = bench.measure(noise_of("model"));
  int seen = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    if (!bench.exact().counts(i) || !(out.z[i] > 0.0f)) continue;
    ++seen;
    EXPECT_NEAR(out.z[i], bench.exact().z[i], 1e-5f);
  }
  EXPECT_GT(seen, 300);
}

TEST(SensorNoise, SilhouetteCaricatureStaysWithinItsReach) {
  const Bench bench(camera(80, 60, 400.0), {half_wall(1.0, 0.0), wall(1.5)});
  NoiseOptions options;
  options.kind = NoiseKind::kGaussian;
  options.mixed_pixels = 0.5;
  options.mixed_reach_m = 0.08;
  const MeasuredGrid out = bench.measure(options);
  int moved = 0;
  for (std::size_t i = 0; i < out.z.size(); ++i) {
    const float behind = out.z[i] - bench.exact().z[i];
    EXPECT_GE(behind, 0.0f);
    EXPECT_LE(behind, 0.08f);
    moved += behind > 0.0f;
  }
  EXPECT_NEAR(moved, 30, 18);  // half of the 60 pixels along the edge
}

TEST(SensorNoise, SameSeedGivesTheSameBytesOnAnyThread) {
  ScannerModel m = fankhauser();
  m.noise.footprint_px = 1.0;
  m.noise.lateral_m = 0.0016;
  m.noise.dark_jitter = 0.1;
  m.noise.dark_signal_per_m2 = 0.3;
  const Bench bench = step(m, 1.0, 1.2);
  const auto noise = SensorNoise::create(m, noise_of("model"), 7, 0).value();
  std::vector<MeasuredGrid> serial(6), parallel(6);
  for (std::uint32_t f = 0; f < 6; ++f) noise.apply(bench.view(), bench.exact(), f, serial[f]);
  parallel_for(6, 1, [&](std::size_t f) {
    noise.apply(bench.view(), bench.exact(), std::uint32_t(f), parallel[f]);
  });
  for (std::size_t f = 0; f < 6; ++f) {
    EXPECT_EQ(serial[f].z, parallel[f].z);
    EXPECT_EQ(serial[f].miss, parallel[f].miss);
    EXPECT_NE(serial[f].z, serial[(f + 1) % 6].z);
  }
}

TEST(SensorNoise, SeedFrameAndScannerEachChangeTheNoise) {
  const Bench bench(fankhauser(), {wall(1.0)});
  for (const char* kind : {"gaussian:1mm", "model"}) {
    const MeasuredGrid out = bench.measure(noise_of(kind), 3, 5, 1);
    EXPECT_EQ(bench.measure(noise_of(kind), 3, 5, 1).z, out.z);
    EXPECT_NE(bench.measure(noise_of(kind), 4, 5, 1).z, out.z);
    EXPECT_NE(bench.measure(noise_of(kind), 3, 6, 1).z, out.z);
    EXPECT_NE(bench.measure(noise_of(kind), 3, 5, 2).z, out.z);
  }
}

TEST(SensorNoise, WhatIsNotSeenStaysMissingForItsReason) {
  ScannerModel m = fankhauser();
  m.far_m = 1.1;
  const Bench bench = step(m, 1.0, 1.2);
  for (const char* kind : {"none", "gaussian:1mm", "model"}) {
    const MeasuredGrid out = bench.measure(noise_of(kind));
    int far = 0;
    for (std::size_t i = 0; i < out.z.size(); ++i) {
      EXPECT_EQ(out.z[i] > 0.0f, out.miss[i] == Miss::kNone);
      EXPECT_EQ(out.miss[i], bench.exact().miss[i]);
      far += out.miss[i] == Miss::kTooFar;
    }
    EXPECT_GT(far, 1000);
  }
}

TEST(SensorNoise, PredictedSigmaIsThatOfTheSample) {
  const Bench bench(fankhauser(), {wall(1.0, 0.6)});
  const auto noise = SensorNoise::create(bench.model(), noise_of("model"), 1, 0).value();
  const MeasuredGrid out = bench.measure(noise_of("model"), 0, 1, 0, true);
  ASSERT_EQ(out.sigma_m.size(), out.z.size());
  for (std::size_t i = 0; i < out.z.size(); i += 7) {
    if (bench.exact().counts(i)) {
      EXPECT_NEAR(out.sigma_m[i], noise.predicted_sigma_m(bench.exact().z[i], bench.incidence(i)),
                  1e-7);
    } else {
      EXPECT_EQ(out.sigma_m[i], 0.0f);
    }
  }
  EXPECT_TRUE(bench.measure(noise_of("model")).sigma_m.empty());
  const auto gaussian = SensorNoise::create(bench.model(), noise_of("gaussian:2mm"), 1, 0).value();
  EXPECT_EQ(gaussian.predicted_sigma_m(1.0, 0.3), 2e-3);
}

TEST(SensorNoise, AnEmptyViewGivesNothing) {
  for (const char* kind : {"none", "gaussian:1mm", "model"}) {
    const Bench bench(fankhauser(), {TriangleMesh()});
    EXPECT_TRUE(bench.measure(noise_of(kind)).z.empty());
  }
}

TEST(SensorNoise, RefusesOptionsOutOfRange) {
  const auto refused = [](const ScannerModel& m, const NoiseOptions& o, const char* named) {
    const auto noise = SensorNoise::create(m, o, 1, 0);
    ASSERT_FALSE(noise) << named;
    EXPECT_EQ(noise.error().code, ErrorCode::kInvalidOption);
    EXPECT_NE(noise.error().message.find(named), std::string::npos) << noise.error().message;
  };
  NoiseOptions o;
  o.sigma_m = kNoDepth;
  refused(fankhauser(), o, "sigma");
  o = NoiseOptions();
  o.mixed_pixels = 1.5;
  refused(fankhauser(), o, "mixed-pixels");
  o = NoiseOptions();
  o.mixed_reach_m = -1.0;
  refused(fankhauser(), o, "mixed-reach");
  refused(fankhauser(), noise_of("physics"), "physics");
  ScannerModel m = fankhauser();
  m.noise.footprint_px = -1.0;
  refused(m, noise_of("model"), "footprint");
  m = fankhauser();
  m.noise.physics = SensorPhysics::kLaserLine;
  refused(m, noise_of("physics"), "line");
}

TEST(FocalBaseline, IsOfTheCameraOrOfTheLinesOwn) {
  ScannerModel m = camera(10, 10, 400.0);
  EXPECT_EQ(focal_baseline(m), 0.0);
  m.emitter_m = Vec3d(0.03, 0.04, 0.0);
  EXPECT_DOUBLE_EQ(focal_baseline(m), 400.0 * 0.05);
  m.kind = ScannerKind::kLine;
  m.noise.line_focal_px = 2000.0;
  m.receiver_m = Vec3d(-0.1, 0.02, 0.0);
  EXPECT_DOUBLE_EQ(focal_baseline(m), 2000.0 * 0.1);
}

TEST(NoisePresets, PredictWhatIsPublished) {
  const auto sigma_mm = [](const char* preset, double z, double incidence) {
    const ScannerModel model = find_scanner(preset).value();
    return 1e3 * SensorNoise::create(model, noise_of("model"), 1, 0)
                     .value()
                     .predicted_sigma_m(z, incidence);
  };
  EXPECT_NEAR(sigma_mm("kinect-v1", 1.4, 0.3), 1.2 + 1.9, 1e-6);
  EXPECT_NEAR(sigma_mm("kinect-v2", 0.8, 0.0), 1.292, 1e-3);
  EXPECT_NEAR(sigma_mm("azure-kinect", 1.5, 0.0), 1.5, 1e-6);
  EXPECT_NEAR(sigma_mm("orbbec-femto", 1.5, 0.0), 1.5, 1e-6);
  const ScannerModel d435 = find_scanner("realsense-d435").value();
  EXPECT_NEAR(sigma_mm("realsense-d435", 0.8, 0.0), 640.0 * 0.08 / (d435.camera.fx * 0.05), 1e-6);
  // A profile scanner of this kind repeats to a few hundredths of a millimetre.
  EXPECT_GT(sigma_mm("gocator", 0.5, 0.0), 0.005);
  EXPECT_LT(sigma_mm("gocator", 0.5, 0.0), 0.05);
  EXPECT_EQ(sigma_mm("ideal", 1.0, 0.0), 0.0);
}

TEST(NoisePresets, HavePhysicsWhereTheyClaimIt) {
  for (const std::string& preset : scanner_presets()) {
    const ScannerModel model = find_scanner(preset).value();
    EXPECT_EQ(SensorNoise::create(model, noise_of("physics"), 1, 0).has_value(),
              preset == "kinect-v2" || preset == "gocator")
        << preset;
  }
}

TEST(TriangleAlbedos, AreLinearMeansOfTheCorners) {
  TriangleMesh mesh = wall(1.0);
  EXPECT_TRUE(triangle_albedos(mesh).empty());
  mesh.colors = {{255, 255, 255}, {255, 255, 255}, {255, 255, 255}, {0, 0, 0}};
  const std::vector<float> albedos = triangle_albedos(mesh);
  ASSERT_EQ(albedos.size(), 2u);
  EXPECT_NEAR(albedos[0], 1.0f, 1e-6f);
  EXPECT_NEAR(albedos[1], 2.0f / 3.0f, 1e-6f);
}

/// Taken out by the sensor's own filters.
int lost(const MeasuredGrid& out) {
  return int(std::count(out.miss.begin(), out.miss.end(), Miss::kRejected));
}

ScannerModel windowed(int window) {
  ScannerModel m = camera(140, 110, 585.0);
  m.sensing = Sensing::kStructuredLight;
  m.emitter_m = {0.075, 0.0, 0.0};
  m.noise.window_px = window;
  return m;
}

TEST(SensorNoise, AMatcherOfDotsFindsAWholeWallAndLosesWhatIsNarrowerThanItsWindow) {
  const Bench whole(windowed(9), {wall(1.0)});
  // But for windows that no dot falls into: at the image's corners they are small.
  EXPECT_LE(lost(whole.measure(noise_of("model"))), 140 * 110 / 500);
  // A post of 4 pixels before a wall 0.5 m behind, and one of 40.
  for (const auto& [width, least, most] : {std::tuple(4, 0.9, 1.0), std::tuple(40, 0.0, 0.25)}) {
    TriangleMesh post = wall(1.0);
    for (Vec3f& p : post.vertices) p.x() *= float(0.5 * width / 585.0 / 20.0);
    const Bench bench(windowed(9), {post, wall(1.5)});
    const MeasuredGrid out = bench.measure(noise_of("model"));
    double all = 0.0, rejected = 0.0;
    for (std::size_t i = 0; i < out.z.size(); ++i) {
      if (!bench.exact().counts(i) || bench.exact().z[i] > 1.2f) continue;
      all += 1.0;
      rejected += out.miss[i] == Miss::kRejected ? 1.0 : 0.0;
      EXPECT_EQ(out.miss[i] == Miss::kNone, out.z[i] > 0.0f);
    }
    ASSERT_GT(all, 300.0);
    EXPECT_GE(rejected / all, least) << width;
    EXPECT_LE(rejected / all, most) << width;
  }
}

TEST(SensorNoise, TheDotsAreOneSlideOnASensorThatTriangulates) {
  const Bench bench(windowed(9), {half_wall(1.0, 0.0), wall(1.5)});
  const MeasuredGrid a = bench.measure(noise_of("model"), 0),
                     b = bench.measure(noise_of("model"), 7);
  EXPECT_EQ(a.z, b.z);  // no other noise is set: every frame has the same holes
  EXPECT_GT(lost(a), 100);
  ScannerModel without = windowed(9);
  without.emitter_m.setZero();
  const Bench one_eyed(without, {half_wall(1.0, 0.0), wall(1.5)});
  EXPECT_EQ(lost(one_eyed.measure(noise_of("model"))), 0);
}

}  // namespace
}  // namespace turnscan
