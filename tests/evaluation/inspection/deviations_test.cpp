#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <turnscan/evaluation/inspection/deviations.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

TEST(Deviations, AreNegativeInsideAndPositiveOutside) {
  const TriangleMesh ball = sphere(0.1, 4);
  std::vector<Vec3f> points;
  for (const double r : {0.05, 0.09, 0.11, 0.2})
    for (const auto& v : sphere(r, 2).vertices) points.push_back(v);
  const auto found = deviations_from(ball, points, RunContext());
  ASSERT_TRUE(found);
  ASSERT_EQ(found->size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR((*found)[i], points[i].norm() - 0.1f, 3e-4f) << i;
}

TEST(Deviations, OfPointsThatAreNotFiniteAreNotNumbers) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto found = deviations_from(cube(), std::vector<Vec3f>{{nan, 0, 0}}, RunContext());
  ASSERT_TRUE(found);
  EXPECT_TRUE(std::isnan(found->front()));
}

TEST(Deviations, ToAReferenceWithoutTrianglesAreRefused) {
  const auto found = deviations_from({}, std::vector<Vec3f>{{0, 0, 0}}, RunContext());
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kTooFewPoints);
}

TEST(Deviations, EndWhenTheyAreCancelled) {
  RunContext context;
  context.cancel();
  const auto found = deviations_from(cube(), std::vector<Vec3f>(5000, {2, 2, 2}), context);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

TEST(Deviations, GetColoursThatTellInAboveAndBelowApart) {
  const auto color = [](double mm) { return deviation_color(1e-3 * mm, 0.5e-3, 2e-3); };
  const auto same = [](const Rgb& a, const Rgb& b) {
    return a.r == b.r && a.g == b.g && a.b == b.b;
  };
  EXPECT_TRUE(same(color(0.0), color(0.5)));
  EXPECT_TRUE(same(color(0.0), color(-0.5)));
  EXPECT_TRUE(same(color(2.0), color(9.0))) << "the range ends";
  EXPECT_TRUE(same(color(-2.0), color(-9.0)));
  for (const double mm : {0.6, 1.0, 2.0}) {
    EXPECT_GT(color(mm).r, color(mm).b) << mm;
    EXPECT_GT(color(-mm).b, color(-mm).r) << mm;
  }
  EXPECT_GT(color(0.6).g, color(1.9).g) << "farther is darker";
}

TEST(Deviations, AreATableInMillimetres) {
  const std::string text =
      deviations_csv(std::vector<Vec3f>{{0.001f, 0.002f, -0.003f}}, std::vector<float>{-0.00025f});
  EXPECT_EQ(text, "x_mm,y_mm,z_mm,deviation_mm\n1.0000,2.0000,-3.0000,-0.25000\n");
}

}  // namespace
}  // namespace turnscan
