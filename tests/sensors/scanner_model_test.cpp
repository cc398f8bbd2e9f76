#include <turnscan/core/angles.hpp>
#include <turnscan/sensors/scanner_model.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

ScannerParameters matrix() {
  ScannerParameters p;
  p.columns = 640;
  p.rows = 480;
  p.fov_y_rad = 45.0 * kRadiansPerDegree;
  return p;
}

ScannerParameters line() {
  ScannerParameters p;
  p.kind = ScannerKind::kLine;
  p.rows = 1280;
  p.fov_y_rad = 30.0 * kRadiansPerDegree;
  return p;
}

ScannerModel model_of(const ScannerParameters& p) {
  auto model = scanner_model(p);
  EXPECT_TRUE(model) << (model ? "" : model.error().text());
  return *model;
}

void expect_refused(const ScannerParameters& p, const std::string& says) {
  const auto model = scanner_model(p);
  ASSERT_FALSE(model) << says;
  EXPECT_EQ(model.error().code, ErrorCode::kInvalidOption);
  EXPECT_NE(model.error().message.find(says), std::string::npos) << model.error().message;
}

TEST(ScannerModel, SpreadsItsSamplesOverTheFieldOfView) {
  ScannerParameters p = matrix();
  p.aspect = 1.5;
  const ScannerModel model = model_of(p);
  // The edge of the image is half a sample beyond its last one.
  const double tangent = std::tan(22.5 * kRadiansPerDegree);
  EXPECT_NEAR(model.camera.ray(0, 479.5).y(), tangent, 1e-12);
  EXPECT_NEAR(model.camera.ray(0, -0.5).y(), -tangent, 1e-12);
  EXPECT_NEAR(model.camera.ray(639.5, 0).x(), 1.5 * tangent, 1e-12);
}

TEST(ScannerModel, HasSquareSamplesWithoutAnAspect) {
  const ScannerModel model = model_of(matrix());
  EXPECT_DOUBLE_EQ(model.camera.fx, model.camera.fy);
  EXPECT_DOUBLE_EQ(model.camera.cx, 319.5);
  EXPECT_DOUBLE_EQ(model.camera.cy, 239.5);
}

TEST(ScannerModel, KeepsTheStatedNumberOfSamplesAcrossTheViewAtTheNearestDistance) {
  const ScannerModel model = model_of(matrix());
  const double height = 2.0 * model.near_m * std::tan(22.5 * kRadiansPerDegree);
  const double step = model.near_m / model.camera.fy;
  EXPECT_NEAR(height / step, 480.0, 1e-9);
}

TEST(ScannerModel, TakesFocalLengthCentreAndDistortionOfALens) {
  ScannerParameters p = matrix();
  p.fov_y_rad.reset();
  p.fx = 500.0;
  p.fy = 510.0;
  p.cx = 300.0;
  p.cy = 250.0;
  p.k1 = 0.1;
  p.k3 = -0.02;
  const ScannerModel model = model_of(p);
  EXPECT_EQ(model.camera.fx, 500.0);
  EXPECT_EQ(model.camera.fy, 510.0);
  EXPECT_EQ(model.camera.cx, 300.0);
  EXPECT_EQ(model.camera.cy, 250.0);
  EXPECT_EQ(model.camera.distortion, (std::array<double, 8>{0.1, 0, 0, 0, -0.02}));
}

TEST(ScannerModel, PutsTheEmitterOfAMatrixScannerWhereTheDirectionSays) {
  ScannerParameters p = matrix();
  p.baseline_m = 0.075;
  EXPECT_TRUE(model_of(p).emitter_m.isApprox(Vec3d(0.075, 0, 0)));
  p.baseline_direction_rad = 90.0 * kRadiansPerDegree;  // above: y points down
  EXPECT_TRUE(model_of(p).emitter_m.isApprox(Vec3d(0, -0.075, 0)));
  EXPECT_EQ(model_of(p).receiver_m, Vec3d::Zero());
  EXPECT_TRUE(model_of(p).two_eyed());
}

TEST(ScannerModel, StartsTheRaysOfALineAtItsLaser) {
  ScannerParameters p = line();
  p.baseline_m = 0.2;
  const ScannerModel model = model_of(p);
  EXPECT_EQ(model.emitter_m, Vec3d::Zero());
  EXPECT_TRUE(model.receiver_m.isApprox(Vec3d(0.2, 0, 0)));
  EXPECT_EQ(model.other_eye_m(), model.receiver_m);
  EXPECT_EQ(model.camera.width, 1);
  EXPECT_EQ(model.camera.height, 1280);
  for (int row : {0, 600, 1279}) EXPECT_EQ(model.camera.ray(0, row).x(), 0.0);
}

TEST(ScannerModel, HasOneEyeWithoutABaseline) {
  EXPECT_FALSE(model_of(matrix()).two_eyed());
  EXPECT_FALSE(model_of(line()).two_eyed());
}

TEST(ScannerModel, RefusesWhatCannotBe) {
  ScannerParameters p = matrix();
  p.near_m = 2.0;
  p.far_m = 1.0;
  expect_refused(p, "near = 2000mm is not below far = 1000mm");
  p = matrix();
  p.near_m = p.far_m;
  expect_refused(p, "is not below");
  p = matrix();
  p.rows = 0;
  expect_refused(p, "640 x 0 samples");
  p = matrix();
  p.columns = 0;
  expect_refused(p, "0 x 480 samples");
  p = line();
  p.columns = 7;
  expect_refused(p, "columns = 7");
  p = matrix();
  p.fy = 500.0;
  expect_refused(p, "not both");
  p.fov_y_rad.reset();
  p.aspect = 1.0;
  expect_refused(p, "aspect goes with vertical-fov");
  p.aspect.reset();
  p.fy.reset();
  expect_refused(p, "either vertical-fov or");
  p = matrix();
  p.near_m = std::nan("");
  expect_refused(p, "near");
  p = matrix();
  p.noise.bias_m = std::nan("");
  expect_refused(p, "bias");
}

TEST(ScannerModel, ChecksWhatWasSetByHand) {
  ScannerModel model = model_of(line());
  model.camera.width = 2;
  EXPECT_FALSE(model.check());
  model = model_of(matrix());
  model.emitter_m.x() = std::nan("");
  EXPECT_FALSE(model.check());
  model = model_of(matrix());
  model.max_incidence_rad = 2.0;
  EXPECT_FALSE(model.check());
  model = model_of(matrix());
  model.depth_unit_m = 0.0;
  EXPECT_FALSE(model.check());
}

}  // namespace
}  // namespace turnscan
