#include <turnscan/geometry/registration/point_pairs.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <turnscan/core/random.hpp>

namespace turnscan {
namespace {

using ::testing::HasSubstr;

constexpr PairLimits kLimits{0.01, 0.01};

Pose half_a_turn() {
  return Eigen::Translation3d(0.02, 0.16, -0.01) *
         Eigen::AngleAxisd(3.1, Vec3d(1.0, 0.1, -0.2).normalized());
}

std::vector<PointPair> pairs_of(const std::vector<Vec3d>& points, const Pose& T) {
  std::vector<PointPair> out;
  for (const Vec3d& p : points) out.push_back({p, T * p});
  return out;
}

const std::vector<Vec3d> kTriangle{{0.0, 0.0, 0.05}, {0.06, 0.02, 0.0}, {-0.03, 0.08, 0.01}};

std::string error_of(const std::vector<PointPair>& pairs, const PairLimits& limits = kLimits) {
  const auto fit = fit_point_pairs(pairs, limits);
  return fit ? "" : fit.error().message;
}

TEST(PointPairs, ThreeGiveBackTheMotion) {
  const auto fit = fit_point_pairs(pairs_of(kTriangle, half_a_turn()), kLimits);
  ASSERT_TRUE(fit) << fit.error().text();
  EXPECT_TRUE(fit->T_target_source.isApprox(half_a_turn(), 1e-9));
  EXPECT_LT(fit->rms_m, 1e-9);
  EXPECT_EQ(fit->residuals_m.size(), 3u);
}

TEST(PointPairs, ThePlaneOfThreeDoesNotBecomeItsMirror) {
  for (int i = 0; i < 50; ++i) {
    const Vec3d axis = Vec3d(std::cos(i), std::sin(1.7 * i), std::cos(2.3 * i)).normalized();
    const Pose T(Eigen::AngleAxisd(0.1 * i, axis));
    const auto fit = fit_point_pairs(pairs_of(kTriangle, T), kLimits);
    ASSERT_TRUE(fit) << fit.error().text();
    EXPECT_NEAR(fit->T_target_source.linear().determinant(), 1.0, 1e-9);
    EXPECT_TRUE(fit->T_target_source.isApprox(T, 1e-9)) << i;
  }
}

/// No small motion more brings the points nearer together.
TEST(PointPairs, MoreThanThreeAreFittedInTheLeastSquaresSense) {
  std::vector<Vec3d> points = kTriangle;
  points.emplace_back(0.05, -0.04, -0.03);
  points.emplace_back(-0.06, 0.01, -0.05);
  auto pairs = pairs_of(points, half_a_turn());
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (int k = 0; k < 3; ++k)
      pairs[i].target[k] += 2e-3 * (double(hash_key(i, std::uint64_t(k)) % 1000) / 500.0 - 1.0);
  const auto fit = fit_point_pairs(pairs, kLimits);
  ASSERT_TRUE(fit) << fit.error().text();
  const auto cost = [&](const Pose& T) {
    double sum = 0.0;
    for (const PointPair& pair : pairs) sum += (T * pair.source - pair.target).squaredNorm();
    return sum;
  };
  const double best = cost(fit->T_target_source);
  EXPECT_NEAR(best, fit->rms_m * fit->rms_m * double(pairs.size()), 1e-15);
  for (int k = 0; k < 3; ++k)
    for (const double step : {-1e-4, 1e-4}) {
      const Pose shift(Eigen::Translation3d(step * Vec3d::Unit(k)));
      const Pose turn(Eigen::AngleAxisd(step, Vec3d::Unit(k)));
      EXPECT_GT(cost(shift * fit->T_target_source), best);
      EXPECT_GT(cost(fit->T_target_source * turn), best);
    }
}

TEST(PointPairs, FewerThanThreeAreTooFew) {
  auto pairs = pairs_of(kTriangle, half_a_turn());
  pairs.pop_back();
  EXPECT_THAT(error_of(pairs), HasSubstr("2 of at least 3"));
  EXPECT_THAT(error_of({}), HasSubstr("0 of at least 3"));
}

TEST(PointPairs, PointsTooNearToEachOtherAreRefused) {
  std::vector<Vec3d> points = kTriangle;
  for (Vec3d& p : points) p *= 0.1;
  EXPECT_THAT(error_of(pairs_of(points, half_a_turn())), HasSubstr("too near to each other"));
  EXPECT_THAT(error_of(std::vector<PointPair>(3), {0.0, 1.0}), HasSubstr("too near to each other"));
}

TEST(PointPairs, PointsOnAStraightLineAreRefused) {
  const std::vector<Vec3d> points{{0.0, 0.0, 0.0}, {0.05, 0.05, 0.0}, {0.1, 0.1, 0.008}};
  EXPECT_THAT(error_of(pairs_of(points, half_a_turn())), HasSubstr("one straight line"));
  // Of either side alone, too.
  auto pairs = pairs_of(kTriangle, Pose::Identity());
  for (std::size_t i = 0; i < 3; ++i) pairs[i].target = points[i];
  EXPECT_THAT(error_of(pairs), HasSubstr("one straight line"));
  for (PointPair& pair : pairs) std::swap(pair.source, pair.target);
  EXPECT_THAT(error_of(pairs), HasSubstr("one straight line"));
}

TEST(PointPairs, APairThatContradictsTheOthersIsNamed) {
  std::vector<Vec3d> points = kTriangle;
  points.emplace_back(0.05, -0.04, -0.03);
  auto pairs = pairs_of(points, half_a_turn());
  pairs[1].target += Vec3d(0.0, 0.0, 0.05);
  EXPECT_THAT(error_of(pairs), HasSubstr("pair 2 lies"));
}

TEST(PointPairs, WhatIsNotFiniteIsRefused) {
  auto pairs = pairs_of(kTriangle, half_a_turn());
  pairs[2].source.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of(pairs), HasSubstr("not finite"));
}

}  // namespace
}  // namespace turnscan
