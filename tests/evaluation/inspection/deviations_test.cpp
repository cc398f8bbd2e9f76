#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
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
  const auto prepared = SignedDistance::to(cube(), context);
  ASSERT_FALSE(prepared);
  EXPECT_EQ(prepared.error().code, ErrorCode::kCancelled);
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

TEST(Deviations, AreTheSameAskedOneByOne) {
  const TriangleMesh ring = torus(0.05, 0.02, 40, 24);
  const auto one_by_one = SignedDistance::to(ring, RunContext());
  ASSERT_TRUE(one_by_one);
  const auto points = sphere(0.05, 3).vertices;
  const auto at_once = deviations_from(ring, points, RunContext());
  ASSERT_TRUE(at_once);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_EQ((*at_once)[i], float(one_by_one->at(points[i].cast<double>())));
  EXPECT_FALSE(SignedDistance::to({}, RunContext()));
}

TEST(DeviationFigures, OfABallInABallAreTheDifferenceOfRadii) {
  const TriangleMesh ball = sphere(0.1, 4), smaller = sphere(0.099, 3);
  const auto found = deviations_from(ball, smaller.vertices, RunContext());
  ASSERT_TRUE(found);
  const auto shares = surface_shares(smaller);
  const DeviationFigures f = deviation_figures(*found, shares, 0.0005);
  EXPECT_EQ(f.count, smaller.vertices.size());
  EXPECT_NEAR(f.mean_m, -0.001, 2e-4);
  EXPECT_NEAR(f.rms_m, 0.001, 2e-4);
  EXPECT_DOUBLE_EQ(f.below, 1.0);
  EXPECT_DOUBLE_EQ(f.within + f.above, 0.0);
  const auto bins = deviation_histogram(*found, shares, 0.002, 10);
  EXPECT_NEAR(bins[2], 1.0, 0.1);
}

TEST(DeviationFigures, CountBySurfaceAndNotByVertices) {
  // Many small triangles above, few large ones of the same area below.
  TriangleMesh two = plane(20, 1.0, 1.0f);
  append(two, plane(2, 1.0, -1.0f));
  std::vector<float> deviations;
  for (const Vec3f& p : two.vertices) deviations.push_back(p.z());
  const auto shares = surface_shares(two);
  const DeviationFigures f = deviation_figures(deviations, shares, 0.5);
  EXPECT_NEAR(f.above, 0.5, 1e-6);
  EXPECT_NEAR(f.below, 0.5, 1e-6);
  EXPECT_NEAR(f.mean_m, 0.0, 1e-6);
  EXPECT_GT(deviation_figures(deviations, {}, 0.5).above, 0.9);
  const auto bins = deviation_histogram(deviations, shares, 2.0, 4);
  EXPECT_NEAR(bins[1] + bins[0], 0.5, 1e-6);
  EXPECT_NEAR(bins[3] + bins[2], 0.5, 1e-6);
  EXPECT_THROW((void)deviation_figures(deviations, std::vector<float>(3), 0.5),
               std::invalid_argument);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(deviation_figures(std::vector<float>{nan}, {}, 0.5).count, 0u);
}

}  // namespace
}  // namespace turnscan
