#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/mesh/low_pass.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

/// A sheet of unit cells of 1 mm with waves along x, 0.1 mm high.
TriangleMesh waves(int side, double wavelength_m) {
  TriangleMesh mesh;
  const auto n = std::uint32_t(side + 1);
  for (std::uint32_t y = 0; y < n; ++y)
    for (std::uint32_t x = 0; x < n; ++x)
      mesh.vertices.emplace_back(
          1e-3f * (float(x) + 0.5f * float(y % 2)), 1e-3f * 0.866f * float(y),
          1e-4f *
              float(std::sin(2 * std::numbers::pi * 1e-3 * (x + 0.5 * (y % 2)) / wavelength_m)));
  for (std::uint32_t y = 0; y + 1 < n; ++y) {
    for (std::uint32_t x = 0; x + 1 < n; ++x) {
      const std::uint32_t a = y * n + x, b = a + 1, c = a + n, d = c + 1;
      if (y % 2 == 0) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({b, d, c});
      } else {
        mesh.triangles.push_back({a, d, c});
        mesh.triangles.push_back({a, b, d});
      }
    }
  }
  return mesh;
}

/// Root mean square height in the middle of the sheet, over that of the waves as made.
double remaining_height(const TriangleMesh& mesh, int side) {
  double sum = 0.0;
  int count = 0;
  const int n = side + 1;
  for (int y = side / 3; y < 2 * side / 3; ++y)
    for (int x = side / 3; x < 2 * side / 3; ++x, ++count)
      sum += std::pow(double(mesh.vertices[std::size_t(y * n + x)].z()), 2);
  return std::sqrt(2.0 * sum / count) / 1e-4;
}

TEST(LowPass, HalvesWavesOfTheLengthKeepsLongerOnesAndTakesShorterOnesAway) {
  constexpr int kCells = 120;
  for (const double length_m : {0.008, 0.012}) {
    const auto same = low_pass(waves(kCells, length_m), length_m, {});
    const auto longer = low_pass(waves(kCells, 3.0 * length_m), length_m, {});
    const auto shorter = low_pass(waves(kCells, length_m / 2.0), length_m, {});
    ASSERT_TRUE(same && longer && shorter);
    EXPECT_NEAR(remaining_height(*same, kCells), 0.5, 0.06) << length_m;
    EXPECT_GT(remaining_height(*longer, kCells), 0.95) << length_m;
    EXPECT_LT(remaining_height(*shorter, kCells), 0.09) << length_m;
  }
}

TEST(LowPass, LeavesOpenEdgesWhereTheyAre) {
  const TriangleMesh mesh = waves(20, 0.004);
  const auto out = low_pass(mesh, 0.01, {});
  ASSERT_TRUE(out);
  for (std::size_t x = 0; x <= 20; ++x) EXPECT_EQ(out->vertices[x], mesh.vertices[x]);
  EXPECT_NE(out->vertices[10 * 21 + 10], mesh.vertices[10 * 21 + 10]);
}

TEST(LowPass, DoesNotShrinkASphere) {
  const TriangleMesh ball = test::sphere(0.05, 5);
  const auto out = low_pass(ball, 0.02, {});
  ASSERT_TRUE(out);
  for (const Vec3f& p : out->vertices) EXPECT_NEAR(p.norm(), 0.05f, 2e-4f);
}

TEST(LowPass, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = waves(100, 0.005);
  set_thread_count(1);
  const auto one = low_pass(mesh, 0.006, {});
  set_thread_count(4);
  const auto four = low_pass(mesh, 0.006, {});
  set_thread_count(0);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->vertices, four->vertices);
}

TEST(LowPass, StopsWhenCancelledAndRefusesLengthsThatAreNone) {
  const RunContext context;
  context.cancel();
  const TriangleMesh mesh = waves(10, 0.005);
  EXPECT_EQ(low_pass(mesh, 0.006, context).error().code, ErrorCode::kCancelled);
  EXPECT_EQ(low_pass(mesh, 0.0, {}).error().code, ErrorCode::kInvalidOption);
  EXPECT_EQ(low_pass(mesh, std::nan(""), {}).error().code, ErrorCode::kInvalidOption);
}

}  // namespace
}  // namespace turnscan
