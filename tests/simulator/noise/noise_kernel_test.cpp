// The kernels against plain arithmetic in double, and against each other.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <turnscan/simulator/noise/noise_kernel.hpp>
#include <vector>

namespace turnscan {
namespace {

using noise::NoiseKernel;
using noise::NoiseKernels;

constexpr noise::Key kKernelKey{0x12345678u, 0x9abcdef0u, 0x0f1e2d3cu, 0x4b5a6978u};
constexpr int kMany = 200003;

std::vector<float> draws(const NoiseKernel& kernel, std::uint32_t first = 0, int n = kMany) {
  std::vector<float> out(static_cast<std::size_t>(n));
  kernel.normals(kKernelKey, first, 1, n, out.data());
  return out;
}

TEST(NoiseKernel, NormalsHaveTheMomentsOfTheNormalDistribution) {
  double sum[5] = {};
  for (const float x : draws(noise::NoiseKernels::current()))
    for (int k = 1; k <= 4; ++k) sum[k] += std::pow(double(x), k);
  const double root = std::sqrt(double(kMany));
  EXPECT_NEAR(sum[1] / kMany, 0.0, 4.5 / root);
  EXPECT_NEAR(sum[2] / kMany, 1.0, 4.5 * std::sqrt(2.0) / root);
  EXPECT_NEAR(sum[3] / kMany, 0.0, 4.5 * std::sqrt(15.0) / root);
  EXPECT_NEAR(sum[4] / kMany, 3.0, 4.5 * std::sqrt(96.0) / root);
}

TEST(NoiseKernel, NormalsFillTheirDistributionEvenly) {
  constexpr int kBins = 50;
  std::vector<int> count(kBins);
  for (const float x : draws(noise::NoiseKernels::current())) {
    const double p = 0.5 * std::erfc(-double(x) / std::numbers::sqrt2);
    ++count[std::size_t(std::min(int(p * kBins), kBins - 1))];
  }
  double chi2 = 0.0;
  for (const int c : count)
    chi2 += std::pow(c - double(kMany) / kBins, 2) / (double(kMany) / kBins);
  // 49 degrees of freedom: mean 49, standard deviation 9.9.
  EXPECT_LT(chi2, 49.0 + 4.5 * 9.9);
}

TEST(NoiseKernel, NeighboursAndKeysAreIndependent) {
  const std::vector<float> a = draws(noise::NoiseKernels::current());
  std::vector<float> b(a.size());
  for (std::uint32_t other = 1; other < 4; ++other) {
    const noise::Key key{kKernelKey.a + other, kKernelKey.b ^ other, kKernelKey.c + other,
                         kKernelKey.d ^ other};
    noise::NoiseKernels::current().normals(key, 0, 1, kMany, b.data());
    double product = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) product += double(a[i]) * double(b[i]);
    EXPECT_NEAR(product / kMany, 0.0, 4.5 / std::sqrt(double(kMany))) << other;
  }
  for (std::size_t lag : {1u, 2u, 8u, 512u}) {
    double product = 0.0;
    for (std::size_t i = lag; i < a.size(); ++i) product += double(a[i]) * double(a[i - lag]);
    EXPECT_NEAR(product / kMany, 0.0, 4.5 / std::sqrt(double(kMany))) << lag;
  }
}

TEST(NoiseKernel, ADrawDependsOnItsCounterAlone) {
  const std::vector<float> all = draws(noise::NoiseKernels::current(), 0, 1000);
  const std::vector<float> some = draws(noise::NoiseKernels::current(), 137, 50);
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_EQ(some[i], all[i + 137]);
}

TEST(NoiseKernel, PhasorsAreThoseOfThePath) {
  constexpr double kFrequency[3] = {80e6, 16e6, 120e6}, kGain[3] = {1.322581, 1.0, 1.612903};
  std::vector<float> half(500), amplitude(500, 300.0f), buffer(6 * 500);
  for (std::size_t i = 0; i < half.size(); ++i) half[i] = 0.01f * float(i);
  noise::Phasors out{};
  for (int f = 0; f < 3; ++f) {
    out.re[f] = &buffer[std::size_t(f) * 1000];
    out.im[f] = out.re[f] + 500;
  }
  noise::NoiseKernels::current().phasors(500, half.data(), amplitude.data(), out);
  for (int f = 0; f < 3; ++f) {
    for (std::size_t i = 0; i < half.size(); ++i) {
      const double phase = 4.0 * std::numbers::pi * kFrequency[f] / 299792458.0 * double(half[i]);
      EXPECT_NEAR(out.re[f][i], 300.0 / kGain[f] * std::cos(phase), 2e-3) << f << " " << half[i];
      EXPECT_NEAR(out.im[f][i], 300.0 / kGain[f] * std::sin(phase), 2e-3) << f << " " << half[i];
    }
  }
}

TEST(NoiseKernel, EveryInstructionSetGivesTheSameDraws) {
  ASSERT_NE(NoiseKernels::find(InstructionSet::kPortable), nullptr);
  const std::vector<float> plain = draws(*NoiseKernels::find(InstructionSet::kPortable));
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (const NoiseKernel* kernel = NoiseKernels::find(set)) {
      EXPECT_EQ(draws(*kernel), plain);
    }
  }
}

}  // namespace
}  // namespace turnscan
