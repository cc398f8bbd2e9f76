#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/points/refine_kernel.hpp>
#include <vector>

namespace turnscan::refinement {
namespace {

constexpr std::size_t kPoints = 1003;

struct Data {
  std::array<std::vector<float>, 7> columns;
  Measurements view() const {
    return {columns[0].data(), columns[1].data(), columns[2].data(), columns[3].data(),
            columns[4].data(), columns[5].data(), columns[6].data()};
  }
};

float uniform(std::uint64_t counter) { return float(mix64(counter) >> 40) * 0x1p-24f; }

/// Points in a cube of 10 mm; views all around; each counts up to 5 times. What lies behind the
/// last is not a number.
Data measurements() {
  Data data;
  for (std::size_t c = 0; c < 6; ++c) {
    for (std::size_t i = 0; i < kPoints; ++i)
      data.columns[c].push_back((uniform(10 * i + c) - 0.5f) * (c < 3 ? 0.01f : 2.0f));
    data.columns[c].resize(kPoints + kLanes, std::nanf(""));
  }
  for (std::size_t i = 0; i < kPoints; ++i) data.columns[6].push_back(float(1 + mix64(i) % 5));
  data.columns[6].resize(kPoints + kLanes, std::nanf(""));
  return data;
}

TangentFrame frame() {
  const Vec3f n = Vec3f(0.2f, 1.0f, -0.3f).normalized(), u = n.unitOrthogonal(), v = n.cross(u);
  return {{0.001f, -0.0005f, 0.0f},
          {n.x(), n.y(), n.z()},
          {u.x(), u.y(), u.z()},
          {v.x(), v.y(), v.z()},
          1.0f / 0.004f,
          1.0f / 0.003f,
          0.17f};
}

MomentLanes sums(const RefineKernel& kernel, const Data& data, std::size_t begin, std::size_t end) {
  MomentLanes lanes{};
  kernel.add_moments(data.view(), begin, end, frame(), lanes);
  return lanes;
}

/// By the definition, in double.
std::array<double, kMoments> plain_sums(const Data& data, std::size_t begin, std::size_t end) {
  const TangentFrame f = frame();
  const auto dot = [](const float* a, const Vec3d& d) {
    return a[0] * d.x() + a[1] * d.y() + a[2] * d.z();
  };
  std::array<double, kMoments> out{};
  for (std::size_t i = begin; i < end; ++i) {
    const auto& c = data.columns;
    const Vec3d d(c[0][i] - f.p[0], c[1][i] - f.p[1], c[2][i] - f.p[2]);
    const Vec3d view(c[3][i], c[4][i], c[5][i]);
    const double x = dot(f.u, d) * f.inverse_reach, y = dot(f.v, d) * f.inverse_reach;
    const double h = dot(f.n, d), s = h * f.inverse_height;
    if (dot(f.n, view) <= f.facing || x * x + y * y >= 1.0 || s * s >= 1.0) continue;
    const double w = c[6][i] * std::pow(1.0 - x * x - y * y, 3) * std::pow(1.0 - s * s, 2);
    std::size_t m = 0;
    for (int degree = 0; degree <= 4; ++degree)
      for (int b = 0; b <= degree; ++b) out[m++] += w * std::pow(x, degree - b) * std::pow(y, b);
    for (int degree = 0; degree <= 2; ++degree)
      for (int b = 0; b <= degree; ++b)
        out[m++] += w * h * std::pow(x, degree - b) * std::pow(y, b);
  }
  return out;
}

TEST(RefineKernel, GivesTheMomentsOfTheDefinition) {
  const Data data = measurements();
  for (const auto& [begin, end] :
       {std::pair<std::size_t, std::size_t>{0, kPoints}, {5, 6}, {7, 29}, {16, 48}, {9, 9}}) {
    const MomentLanes lanes = sums(RefineKernels::current(), data, begin, end);
    const auto expected = plain_sums(data, begin, end);
    for (std::size_t m = 0; m < kMoments; ++m) {
      double sum = 0.0;
      for (const float value : lanes.sum[m]) sum += value;
      EXPECT_NEAR(sum, expected[m], 1e-5 * (1.0 + expected[0])) << "moment " << m;
    }
  }
}

TEST(RefineKernel, GivesTheSameBytesForEveryInstructionSet) {
  const Data data = measurements();
  const RefineKernel* portable = RefineKernels::find(InstructionSet::kPortable);
  ASSERT_NE(portable, nullptr);
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const RefineKernel* wide = RefineKernels::find(set);
    if (wide == nullptr) continue;
    for (std::size_t end = 0; end < 70; ++end) {
      const MomentLanes a = sums(*portable, data, end / 3, end),
                        b = sums(*wide, data, end / 3, end);
      EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0) << "up to " << end;
    }
  }
}

TEST(RefineKernel, RangesAddUp) {
  const Data data = measurements();
  MomentLanes parts{};
  RefineKernels::current().add_moments(data.view(), 0, 160, frame(), parts);
  RefineKernels::current().add_moments(data.view(), 160, kPoints, frame(), parts);
  const MomentLanes whole = sums(RefineKernels::current(), data, 0, kPoints);
  EXPECT_EQ(std::memcmp(&parts, &whole, sizeof whole), 0);
}

}  // namespace
}  // namespace turnscan::refinement
