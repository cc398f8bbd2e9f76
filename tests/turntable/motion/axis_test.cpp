#include <gtest/gtest.h>

#include <turnscan/turntable/motion/axis.hpp>

namespace turnscan::motion {
namespace {

const Vec3d kAxis = Vec3d(0.1, -0.9, 0.2).normalized();

Eigen::Matrix4d covariance(double tilt_rad, double shift_m) {
  return Eigen::Vector4d(tilt_rad, tilt_rad, shift_m, shift_m).cwiseAbs2().asDiagonal();
}

AxisEstimate estimate(double tilt_rad, double shift_m) {
  return {kAxis, Vec3d(0.0, 0.1, 0.8), covariance(tilt_rad, shift_m)};
}

AxisEstimate moved(AxisEstimate from, double tilt_rad, double shift_m) {
  move_axis({tilt_rad, 0.0, 0.0, shift_m}, from.axis, from.center);
  return from;
}

double lean(const AxisEstimate& a, const AxisEstimate& b) { return a.axis.cross(b.axis).norm(); }

double beside(const AxisEstimate& a, const AxisEstimate& b) {
  return a.axis.cross(a.center - b.center).norm();
}

TEST(CombineNested, WithoutBiasIsTheEstimateFromAllData) {
  const AxisEstimate all = estimate(0.001, 0.0001),
                     part = moved(estimate(0.003, 3e-4), 0.002, 2e-4);
  const AxisEstimate found = combine_nested(all, part, covariance(1e-7, 1e-8));
  EXPECT_LT(lean(found, all), 1e-6);
  EXPECT_LT(beside(found, all), 1e-6);
  EXPECT_NEAR(found.covariance(0, 0), all.covariance(0, 0), 1e-12);
}

TEST(CombineNested, WithALargeBiasIsTheEstimateFromAPart) {
  const AxisEstimate all = estimate(0.001, 0.0001),
                     part = moved(estimate(0.003, 3e-4), 0.002, 2e-4);
  const AxisEstimate found = combine_nested(all, part, covariance(1.0, 0.1));
  EXPECT_LT(lean(found, part), 1e-6);
  EXPECT_LT(beside(found, part), 1e-6);
  EXPECT_NEAR(found.covariance(0, 0), part.covariance(0, 0), 1e-10);
  EXPECT_NEAR(found.covariance(3, 3), part.covariance(3, 3), 1e-12);
}

TEST(CombineNested, IsNoLessSureThanEither) {
  const AxisEstimate all = estimate(0.001, 0.0001),
                     part = moved(estimate(0.003, 3e-4), 0.002, 2e-4);
  const Eigen::Matrix4d bias = covariance(0.002, 2e-4);
  const AxisEstimate found = combine_nested(all, part, bias);
  for (int k = 0; k < 4; ++k) {
    EXPECT_LT(found.covariance(k, k), all.covariance(k, k) + bias(k, k));
    EXPECT_LT(found.covariance(k, k), part.covariance(k, k));
    EXPECT_GT(found.covariance(k, k), all.covariance(k, k));
  }
  // Of the way to the part: the bias over bias and what the rest of the data adds.
  EXPECT_NEAR(lean(found, all), 0.002 * 4.0 / (4.0 + 9.0 - 1.0), 1e-6);
}

TEST(CombineNested, ComparesTheAxesAtOneHeight) {
  const AxisEstimate all = estimate(0.001, 0.0001);
  AxisEstimate part = all;
  part.center += 0.3 * part.axis;
  part.covariance = covariance(0.002, 2e-4);
  EXPECT_LT(beside(combine_nested(all, part, covariance(1.0, 0.1)), all), 1e-9);
}

/// A platter that is known exactly but for what platters differ by.
DetectedPlatter platter_at(const Vec3d& center) {
  DetectedPlatter platter;
  platter.axis = kAxis;
  platter.center_m = center;
  return platter;
}

TEST(WithoutViewShift, GoesBackToThePlatterAlongTheViewOnly) {
  const AxisEstimate apparent = estimate(1e-4, 1e-5);
  const Vec3d side = kAxis.cross(Vec3d::UnitZ()).normalized(), view = side.cross(kAxis);
  const DetectedPlatter platter = platter_at(apparent.center + 0.004 * view + 0.002 * side);
  const AxisPrior prior{&platter, view, 0.1};
  const AxisEstimate found = without_view_shift(apparent, prior);
  const Vec3d moved_by = found.center - apparent.center;
  EXPECT_NEAR(moved_by.dot(view), 0.004, 1e-6);
  EXPECT_NEAR(moved_by.dot(side), 0.0, 1e-9);
}

TEST(WithoutViewShift, WithoutAPlatterOnlyWidensTheCentreAlongTheView) {
  const AxisEstimate apparent = estimate(1e-4, 1e-5);
  const Vec3d side = kAxis.cross(Vec3d::UnitZ()).normalized(), view = side.cross(kAxis);
  const AxisEstimate found = without_view_shift(apparent, {nullptr, view, 0.001});
  EXPECT_EQ(found.center, apparent.center);
  const auto [u, v] = tangent_basis(kAxis);
  const Eigen::Matrix2d shifts = found.covariance.bottomRightCorner<2, 2>();
  const auto sigma = [&](const Vec3d& along) {
    const Eigen::Vector2d way(along.dot(u), along.dot(v));
    return std::sqrt(way.dot(shifts * way));
  };
  EXPECT_NEAR(sigma(view), 0.001, 1e-5);
  EXPECT_NEAR(sigma(side), 1e-5, 1e-9);
}

TEST(WithoutViewShift, ChangesNothingWhereThereIsNone) {
  const AxisEstimate apparent = estimate(1e-4, 1e-5);
  const DetectedPlatter platter = platter_at(apparent.center + Vec3d(0.01, 0.0, 0.0));
  const AxisEstimate found = without_view_shift(apparent, {&platter, Vec3d::UnitX(), 0.0});
  EXPECT_EQ(found.center, apparent.center);
  EXPECT_EQ(found.covariance, apparent.covariance);
}

}  // namespace
}  // namespace turnscan::motion
