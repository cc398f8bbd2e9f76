#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <turnscan/simulator/noise/kinect_v2.hpp>

namespace turnscan {
namespace {

using namespace kinect_v2;

constexpr noise::Key kKey{1u, 2u, 3u, 4u};
constexpr noise::Gate kGate{0.5f, 4.5f};

NoiseModel quiet() {
  NoiseModel m;
  m.tof_read_noise = m.tof_shot_noise = m.tof_relative_noise = 0.0;
  return m;
}

/// Parallel lines of sight, emitter at the receiver: z is half the path.
Rays straight(const Layout& layout) {
  return {Plane(layout.size(), 1.0f), Plane(layout.size(), 0.0f), 0.0f};
}

/// Amount of light from a half path: white, facing the sensor.
float amplitude_at(const NoiseModel& m, double half_path, double albedo) {
  return float(m.tof_amplitude * albedo / (half_path * half_path));
}

/// One thing that a pixel sees, and its share of the pixel.
struct Seen {
  double half_path, share, albedo;
};
using View = std::function<std::vector<Seen>(int column, int row)>;

Light light_of(const NoiseModel& m, const Layout& layout, const View& view) {
  Light light;
  light.reset(layout);
  for (int y = 0; y < layout.height; ++y) {
    for (int x = 0; x < layout.width; ++x) {
      for (const Seen& seen : view(x, y)) {
        const float half = float(seen.half_path);
        const float amplitude = float(seen.share) * amplitude_at(m, seen.half_path, seen.albedo);
        float part[6];
        noise::Phasors one{};
        for (int f = 0; f < 3; ++f) {
          one.re[f] = &part[f];
          one.im[f] = &part[3 + f];
        }
        noise::NoiseKernels::current().phasors(1, &half, &amplitude, one);
        const std::size_t i = layout.at(x, y);
        for (std::size_t f = 0; f < 3; ++f) {
          light.re[f][i] += part[f];
          light.im[f][i] += part[3 + f];
        }
        light.amplitude[i] += amplitude;
      }
    }
  }
  return light;
}

Decoded measured(const NoiseModel& m, const Layout& layout, const View& view, noise::Key key = kKey,
                 const noise::NoiseKernel& kernel = noise::NoiseKernels::current()) {
  Light light = light_of(m, layout, view);
  Raw raw;
  expose(light, m, key, 0, std::uint32_t(layout.width), raw, kernel);
  Workspace work;
  Decoded out;
  decode(raw, straight(layout), kGate, work, out, kernel);
  return out;
}

View plane_at(double z, double albedo = 0.8) {
  return [=](int, int) { return std::vector<Seen>{{z, 1.0, albedo}}; };
}

struct Statistics {
  double mean = 0.0, sigma = 0.0;
  int n = 0, lost = 0;
};

/// Without the outermost pixels, which lack neighbours.
Statistics statistics(const Decoded& d) {
  Statistics s;
  double sum = 0.0, squares = 0.0;
  for (int y = 1; y + 1 < d.layout.height; ++y) {
    for (int x = 1; x + 1 < d.layout.width; ++x) {
      const std::size_t i = d.layout.at(x, y);
      if (d.verdict[i] != noise::kGood) {
        ++s.lost;
        continue;
      }
      ++s.n;
      sum += d.z[i];
      squares += double(d.z[i]) * double(d.z[i]);
    }
  }
  s.mean = sum / s.n;
  s.sigma = std::sqrt(std::max(squares / s.n - s.mean * s.mean, 0.0));
  return s;
}

TEST(KinectV2, WithoutNoiseEveryDepthInRangeComesBack) {
  // The 11 bit code remains, in whole numbers where little light returns.
  const Layout layout{32, 24};
  for (double z = 0.52; z < 4.48; z += 0.037) {
    const Statistics s = statistics(measured(quiet(), layout, plane_at(z)));
    EXPECT_EQ(s.lost, 0) << z;
    EXPECT_NEAR(s.mean, z, 1e-3 + 3e-4 * z * z) << z;
  }
}

TEST(KinectV2, PhasesAreUnwrappedUpToEighteenMetres) {
  // The three frequencies repeat together after 18.74 m; 16 MHz alone after 9.37 m.
  const Layout layout{8, 8};
  for (double z = 0.2; z < 18.5; z += 0.0731) {
    NoiseModel m = quiet();
    m.tof_amplitude = 2000.0 * z * z;
    Light light = light_of(m, layout, plane_at(z));
    Raw raw;
    expose(light, m, kKey, 0, 8, raw);
    Workspace work;
    Decoded out;
    decode(raw, straight(layout), {0.1f, 20.0f}, work, out);
    EXPECT_EQ(out.verdict[layout.at(4, 4)], noise::kGood) << z;
    EXPECT_NEAR(out.z[layout.at(4, 4)], z, 2e-3) << z;
  }
}

TEST(KinectV2, CorrelationsAreWholeOrHaveEightBits) {
  const Layout layout{64, 1};
  NoiseModel m = quiet();
  Light light = light_of(m, layout, [](int x, int) {
    return std::vector<Seen>{{0.1 + 0.03 * x, 1.0, 0.8}};
  });
  Raw raw;
  expose(light, m, kKey, 0, 64, raw);
  int coarse = 0;
  for (int x = 0; x < 64; ++x) {
    for (int f = 0; f < 3; ++f) {
      for (int k = 0; k < 3; ++k) {
        constexpr double kGain[3] = {1.322581, 1.0, 1.612903};
        const std::size_t i = layout.at(x, 0);
        const double phase = 2.0 * 3.141592653589793 * k / 3.0;
        const double exact = light.re[std::size_t(f)][i] * std::cos(phase) -
                             light.im[std::size_t(f)][i] * std::sin(phase);
        const double coded = raw.correlations[std::size_t(3 * f + k)][i];
        EXPECT_LE(std::abs(exact), double(light.amplitude[i]) / kGain[f] + 1e-2);
        if (std::abs(exact) > 32704.0) continue;
        const double step =
            std::max(1.0, std::exp2(std::floor(std::log2(std::abs(coded) + 1e-9)) - 7.0));
        EXPECT_EQ(std::fmod(coded, step), 0.0) << coded;
        EXPECT_LE(std::abs(coded - exact), 0.51 * step) << exact;
        coarse += step > 1.0;
      }
    }
  }
  EXPECT_GT(coarse, 50);
}

TEST(KinectV2, AxialSigmaIsThePublishedOne) {
  // Fankhauser et al. 2015, frontal: 1.5 - 0.5 z + 0.3 z^2 mm.
  const Layout layout{120, 100};
  for (const double z : {0.8, 1.2, 2.0, 3.0, 4.0}) {
    const Statistics s = statistics(measured(NoiseModel(), layout, plane_at(z)));
    const double published = 1e-3 * (1.5 - 0.5 * z + 0.3 * z * z);
    RecordProperty("sigma", std::to_string(s.sigma));
    EXPECT_NEAR(s.sigma, published, 0.15 * published) << z;
    EXPECT_EQ(s.lost, 0) << z;
    EXPECT_NEAR(s.mean, z, 2.5e-3) << z;
  }
}

TEST(KinectV2, BlackSurfaceIsLostAndGreyOneIsNoisier) {
  const Layout layout{60, 50};
  const Statistics black = statistics(measured(NoiseModel(), layout, plane_at(3.0, 0.005)));
  EXPECT_GT(black.lost, 2500);
  const Statistics white = statistics(measured(NoiseModel(), layout, plane_at(2.0, 0.8)));
  const Statistics grey = statistics(measured(NoiseModel(), layout, plane_at(2.0, 0.1)));
  EXPECT_GT(grey.sigma, 2.0 * white.sigma);
  EXPECT_NEAR(grey.mean, 2.0, 3e-3);
}

TEST(KinectV2, OutsideTheGateNothingIsTold) {
  const Layout layout{16, 16};
  const Decoded near = measured(quiet(), layout, plane_at(0.45));
  const Decoded far = measured(quiet(), layout, plane_at(4.7));
  for (int y = 1; y < 15; ++y) {
    for (int x = 1; x < 15; ++x) {
      EXPECT_EQ(near.verdict[layout.at(x, y)], noise::kNear);
      EXPECT_EQ(far.verdict[layout.at(x, y)], noise::kFar);
    }
  }
}

/// A step at a slanted edge, so that the pixels along it are shared in all proportions.
View step(double near, double far) {
  return [=](int x, int y) {
    const double edge = 20.0 + 0.21 * y, share = std::clamp(edge - x, 0.0, 1.0);
    std::vector<Seen> seen;
    if (share > 0.0) seen.push_back({near, share, 0.8});
    if (share < 1.0) seen.push_back({far, 1.0 - share, 0.8});
    return seen;
  };
}

TEST(KinectV2, FlyingPixelsLieOnTheLineOfSightBetweenTheSurfaces) {
  // A step of 70 mm is too small for the driver to reject what lies between.
  const Layout layout{44, 60};
  const double near = 1.0, far = 1.07, noise = 5.5 * 1.4e-3;
  const Decoded d = measured(NoiseModel(), layout, step(near, far));
  int flying = 0;
  for (int y = 1; y + 1 < layout.height; ++y) {
    for (int x = 1; x + 1 < layout.width; ++x) {
      const std::size_t i = layout.at(x, y);
      if (d.verdict[i] != noise::kGood) continue;
      EXPECT_GT(d.z[i], near - noise);
      EXPECT_LT(d.z[i], far + noise);
      flying += d.z[i] > near + 0.01 && d.z[i] < far - 0.01;
    }
  }
  EXPECT_GT(flying, 40);
}

TEST(KinectV2, LargeStepsLoseTheirFlyingPixels) {
  const Layout layout{44, 60};
  const double near = 1.0, far = 1.4;
  const Decoded d = measured(NoiseModel(), layout, step(near, far));
  int rejected = 0, between = 0;
  for (int y = 1; y + 1 < layout.height; ++y) {
    for (int x = 1; x + 1 < layout.width; ++x) {
      const std::size_t i = layout.at(x, y);
      rejected += d.verdict[i] == noise::kEdge || d.verdict[i] == noise::kAliased;
      if (d.verdict[i] != noise::kGood) continue;
      EXPECT_GT(d.z[i], near - 0.01);
      EXPECT_LT(d.z[i], far + 0.01);
      between += d.z[i] > near + 0.06 && d.z[i] < far - 0.04;
    }
  }
  EXPECT_GT(rejected, 20);
  EXPECT_EQ(between, 0);
}

TEST(KinectV2, SaturatedPixelsAreLost) {
  NoiseModel m = quiet();
  m.tof_amplitude = 1e6;
  const Statistics s = statistics(measured(m, {16, 16}, plane_at(1.0)));
  EXPECT_EQ(s.n, 0);
}

TEST(KinectV2, AnEmitterBesideTheReceiverIsAllowedFor) {
  const Layout layout{24, 24};
  const double z = 1.0, beside = 0.08;
  // Straight ahead, emitter to the side: half the path is longer than z.
  const double half = 0.5 * (z + std::hypot(z, beside));
  Light light = light_of(quiet(), layout, plane_at(half));
  Raw raw;
  expose(light, quiet(), kKey, 0, 24, raw);
  Rays rays = straight(layout);
  rays.emitter2 = float(beside * beside);
  Workspace work;
  Decoded out;
  decode(raw, rays, kGate, work, out);
  EXPECT_NEAR(statistics(out).mean, z, 1e-3);
}

TEST(KinectV2, EveryInstructionSetGivesTheSameBytes) {
  const Layout layout{77, 40};
  const Decoded plain = measured(NoiseModel(), layout, step(1.0, 1.3), kKey,
                                 *noise::NoiseKernels::find(InstructionSet::kPortable));
  for (const auto set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const noise::NoiseKernel* kernel = noise::NoiseKernels::find(set);
    if (kernel == nullptr) continue;
    const Decoded other = measured(NoiseModel(), layout, step(1.0, 1.3), kKey, *kernel);
    EXPECT_EQ(other.z, plain.z);
    EXPECT_EQ(other.verdict, plain.verdict);
    EXPECT_EQ(other.amplitude, plain.amplitude);
  }
}

}  // namespace
}  // namespace turnscan
