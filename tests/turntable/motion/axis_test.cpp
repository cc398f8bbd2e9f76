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

}  // namespace
}  // namespace turnscan::motion
