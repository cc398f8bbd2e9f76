// The formulae against the papers', written here as the papers write them.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <turnscan/sensors/noise_model.hpp>

namespace turnscan {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

NoiseModel kinect_v1() {
  NoiseModel m;
  m.axial_constant_m = 0.0012;
  m.axial_quadratic_per_m = 0.0019;
  m.axial_quadratic_at_m = 0.4;
  m.axial_grazing = 0.0001;
  m.axial_grazing_power = -0.5;
  m.axial_grazing_from_rad = kPi / 3;
  m.lateral_px = 0.8;
  m.lateral_grazing_px = 0.035;
  m.disparity_step_px = 0.125;
  return m;
}

NoiseModel kinect_v2() {
  NoiseModel m;
  m.axial_constant_m = 0.0015;
  m.axial_linear = -0.0005;
  m.axial_quadratic_per_m = 0.0003;
  m.axial_grazing = 0.0001;
  m.axial_grazing_power = 1.5;
  m.lateral_m = 0.0016;
  return m;
}

TEST(NoiseModel, KinectOneIsNguyensFormula) {
  for (double z = 0.5; z < 4.0; z += 0.25) {
    for (double deg = 0.0; deg < 89.0; deg += 4.0) {
      const double t = deg * kPi / 180.0;
      double nguyen = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
      if (deg >= 60.0) nguyen += 0.0001 / std::sqrt(z) * t * t / ((kPi / 2 - t) * (kPi / 2 - t));
      EXPECT_NEAR(axial_sigma_m(kinect_v1(), z, t), nguyen, 1e-12) << z << " " << deg;
      EXPECT_NEAR(lateral_sigma_px(kinect_v1(), 585.0, z, t), 0.8 + 0.035 * t / (kPi / 2 - t),
                  1e-12);
    }
  }
}

TEST(NoiseModel, KinectTwoIsFankhausersFormula) {
  for (double z = 0.5; z < 4.5; z += 0.25) {
    for (double deg = 0.0; deg < 89.0; deg += 4.0) {
      const double t = deg * kPi / 180.0;
      const double mm = 1.5 - 0.5 * z + 0.3 * z * z +
                        0.1 * std::pow(z, 1.5) * t * t / ((kPi / 2 - t) * (kPi / 2 - t));
      EXPECT_NEAR(axial_sigma_m(kinect_v2(), z, t), 1e-3 * mm, 1e-12) << z << " " << deg;
      EXPECT_NEAR(lateral_sigma_px(kinect_v2(), 365.5, z, t) * z / 365.5, 1.6e-3, 1e-12);
    }
  }
  EXPECT_NEAR(axial_sigma_m(kinect_v2(), 0.8, 0.0), 1.29e-3, 5e-6);
}

TEST(NoiseModel, LinearPartBeginsWhereItIsTold) {
  NoiseModel azure;
  azure.axial_constant_m = 0.0005;
  azure.axial_linear = 0.001;
  azure.axial_linear_from_m = 0.5;
  EXPECT_DOUBLE_EQ(axial_sigma_m(azure, 0.3, 0.0), 0.0005);
  EXPECT_DOUBLE_EQ(axial_sigma_m(azure, 1.5, 0.0), 0.0015);
}

TEST(NoiseModel, SigmaIsNeverNegativeNorInfinite) {
  NoiseModel m = kinect_v2();
  m.axial_constant_m = -1.0;
  EXPECT_EQ(axial_sigma_m(m, 1.0, 0.0), 0.0);
  EXPECT_TRUE(std::isfinite(axial_sigma_m(kinect_v2(), 1.0, kPi / 2)));
  EXPECT_TRUE(std::isfinite(lateral_sigma_px(kinect_v1(), 585.0, 1.0, kPi / 2)));
  EXPECT_EQ(axial_sigma_m(NoiseModel(), 1.0, 1.0), 0.0);
}

TEST(NoiseModel, DisparityComesInWholeSteps) {
  const double focal_baseline = 585.0 * 0.075;
  for (double z = 0.6; z < 4.0; z += 0.0137) {
    const double q = quantised_depth_m(kinect_v1(), focal_baseline, z);
    const double steps = focal_baseline / q * 8.0;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    // Half a step away at most, to first order.
    EXPECT_LE(std::abs(q - z), 0.52 * disparity_step_m(kinect_v1(), focal_baseline, z)) << z;
  }
  EXPECT_NEAR(disparity_step_m(kinect_v1(), focal_baseline, 1.0), 0.125 / focal_baseline, 1e-12);
}

TEST(NoiseModel, WithoutStepsOrBaselineDepthStaysAsItIs) {
  EXPECT_EQ(quantised_depth_m(NoiseModel(), 40.0, 1.2345), 1.2345);
  EXPECT_EQ(quantised_depth_m(kinect_v1(), 0.0, 1.2345), 1.2345);
  EXPECT_EQ(disparity_step_m(kinect_v1(), 0.0, 1.0), 0.0);
  EXPECT_TRUE(std::isinf(quantised_depth_m(kinect_v1(), 1e-3, 10.0)));
}

TEST(NoiseModel, StereoErrorIsIntelsFormula) {
  NoiseModel d435;
  d435.disparity_sigma_px = 0.08;
  const double f = 686.0, b = 0.050;
  for (double z : {0.4, 0.8, 1.6})
    EXPECT_NEAR(predicted_sigma_m(d435, f * b, z, 0.0, 1.0), z * z * 0.08 / (f * b), 1e-12);
}

TEST(NoiseModel, PredictionIsNoFinerThanTheSteps) {
  NoiseModel m;
  m.disparity_step_px = 1.0;
  EXPECT_NEAR(predicted_sigma_m(m, 40.0, 1.0, 0.0, 1.0), 1.0 / 40.0 / std::sqrt(12.0), 1e-12);
}

TEST(NoiseModel, NothingIsPredictedWhereNothingReturns) {
  NoiseModel m = kinect_v2();
  m.dark_signal_per_m2 = 0.1;
  m.drop_from_rad = 1.2;
  m.drop_to_rad = 1.4;
  EXPECT_TRUE(std::isnan(predicted_sigma_m(m, 0.0, 1.0, 0.0, 0.05)));
  EXPECT_TRUE(std::isnan(predicted_sigma_m(m, 0.0, 1.0, 1.45, 1.0)));
  EXPECT_FALSE(std::isnan(predicted_sigma_m(m, 0.0, 1.0, 0.0, 0.5)));
}

TEST(NoiseModel, EveryFieldRefusesNaNAndKeepsItsDefault) {
  NoiseModel m;
  const OptionTable table = describe(m);
  EXPECT_TRUE(table.check());
  for (const OptionField& field : table.fields()) {
    const std::string before = field.get();
    EXPECT_FALSE(field.set("nan")) << field.name;
    EXPECT_TRUE(field.set(before)) << field.name << " " << before;
    EXPECT_EQ(field.get(), before);
  }
  m.bias_m = kNaN;
  ASSERT_FALSE(describe(m).check());
  EXPECT_NE(describe(m).check().error().message.find("bias"), std::string::npos);
}

TEST(NoiseModel, FieldsAreSetByTheNamesOfTheFile) {
  NoiseModel m;
  const OptionTable table = describe(m);
  ASSERT_TRUE(table.set("axial-constant", "1.2mm"));
  ASSERT_TRUE(table.set("drop-from", "70deg"));
  ASSERT_TRUE(table.set("physics", "laser-line"));
  EXPECT_DOUBLE_EQ(m.axial_constant_m, 1.2e-3);
  EXPECT_NEAR(m.drop_from_rad, 70.0 * kPi / 180.0, 1e-12);
  EXPECT_EQ(m.physics, SensorPhysics::kLaserLine);
  EXPECT_FALSE(table.set("drop-from", "91deg"));
  EXPECT_FALSE(table.set("footprint-px", "-1"));
}

}  // namespace
}  // namespace turnscan
