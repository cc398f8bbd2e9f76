#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <turnscan/core/camera.hpp>

namespace turnscan {
namespace {

CameraIntrinsics pinhole() {
  CameraIntrinsics camera;
  camera.width = 512;
  camera.height = 424;
  camera.fx = 365.0;
  camera.fy = 366.0;
  camera.cx = 255.5;
  camera.cy = 211.5;
  return camera;
}

CameraIntrinsics with_distortion(const std::array<double, 8>& distortion) {
  CameraIntrinsics camera = pinhole();
  camera.distortion = distortion;
  return camera;
}

// Typical of the factory calibrations of depth cameras.
const std::array<double, 8> kMild{0.09, -0.27, 0.001, -0.002, 0.09};
const std::array<double, 8> kBarrel{-0.2, 0.03, 0.0, 0.0, 0.0};

TEST(Camera, RayOfThePrincipalPointIsTheOpticalAxis) {
  EXPECT_EQ(pinhole().ray(255.5, 211.5), Vec3d(0, 0, 1));
  EXPECT_TRUE(with_distortion(kMild).ray(255.5, 211.5).isApprox(Vec3d(0, 0, 1)));
}

TEST(Camera, XIsRightAndYIsDown) {
  const Vec3d ray = pinhole().ray(300, 300);
  EXPECT_GT(ray.x(), 0.0);
  EXPECT_GT(ray.y(), 0.0);
}

TEST(Camera, ProjectDistortsAsBrownConradyInTheOrderOfOpenCv) {
  // By hand: x = 0.2, y = 0.1, r2 = 0.05.
  const double radial = 1.0 + 0.1 * 0.05 - 0.2 * 0.0025 + 0.3 * 0.000125;
  const double x = 0.2 * radial + 2 * 0.01 * 0.02 + 0.02 * (0.05 + 2 * 0.04);
  const double y = 0.1 * radial + 0.01 * (0.05 + 2 * 0.01) + 2 * 0.02 * 0.02;
  const CameraIntrinsics camera = with_distortion({0.1, -0.2, 0.01, 0.02, 0.3});
  const Eigen::Vector2d uv = camera.project({0.4, 0.2, 2.0});
  EXPECT_NEAR(uv.x(), 365.0 * x + 255.5, 1e-9);
  EXPECT_NEAR(uv.y(), 366.0 * y + 211.5, 1e-9);
}

TEST(Camera, RayUndoesTheDistortionOverTheWholeImage) {
  for (const auto& distortion : {std::array<double, 8>{}, kMild, kBarrel}) {
    const CameraIntrinsics camera = with_distortion(distortion);
    for (int v = 0; v < camera.height; v += 8) {
      for (int u = 0; u < camera.width; u += 8) {
        const Eigen::Vector2d back = camera.project(camera.ray(u, v) * 1.3);
        ASSERT_NEAR(back.x(), u, 1e-4) << "pixel " << u << ", " << v;
        ASSERT_NEAR(back.y(), v, 1e-4) << "pixel " << u << ", " << v;
      }
    }
  }
}

TEST(Camera, RayIsNotANumberWhereNoRayGivesThatImagePoint) {
  // x (1 - 0.5 x^2) is at most 0.544, at x = 0.816: no ray reaches an image point farther out.
  const CameraIntrinsics camera = with_distortion({-0.5, 0, 0, 0, 0});
  EXPECT_TRUE(camera.ray(255.5 + 0.5 * 365.0, 211.5).allFinite());
  EXPECT_FALSE(camera.ray(255.5 + 0.6 * 365.0, 211.5).allFinite());
}

/// The factory calibration of an Azure Kinect (pyk4a's test recording), rounded, in the mode WFOV.
CameraIntrinsics wide_rational() {
  CameraIntrinsics camera;
  camera.width = camera.height = 1024;
  camera.fx = 504.6, camera.fy = 504.7;
  camera.cx = 524.8, camera.cy = 528.8;
  camera.distortion = {0.54794,   -0.02097, 2.056e-5, -7.21e-5,
                       -0.002652, 0.88968,  0.08613,  -0.01391};
  return camera;
}

TEST(Camera, ProjectDividesByTheRationalModelsDenominator) {
  // By hand: x = 0.2, y = 0.1, r2 = 0.05.
  const double radial = (1.0 + 0.1 * 0.05 - 0.2 * 0.0025 + 0.3 * 0.000125) /
                        (1.0 + 0.4 * 0.05 + 0.5 * 0.0025 - 0.6 * 0.000125);
  const double x = 0.2 * radial + 2 * 0.01 * 0.02 + 0.02 * (0.05 + 2 * 0.04);
  const CameraIntrinsics camera = with_distortion({0.1, -0.2, 0.01, 0.02, 0.3, 0.4, 0.5, -0.6});
  EXPECT_TRUE(camera.rational());
  EXPECT_NEAR(camera.project({0.4, 0.2, 2.0}).x(), 365.0 * x + 255.5, 1e-9);
  EXPECT_FALSE(with_distortion(kMild).rational());
}

TEST(Camera, RayUndoesTheRationalModelUpToItsEnd) {
  const CameraIntrinsics camera = wide_rational();
  const double most = std::sqrt(camera.lens().largest_r2);
  EXPECT_GT(most, 1.75);  // the calibration's own word is 1.74
  int covered = 0, beyond = 0;
  for (int v = 0; v < camera.height; v += 16) {
    for (int u = 0; u < camera.width; u += 16) {
      const Vec3d ray = camera.ray(u, v);
      if (!ray.allFinite()) {
        ++beyond;
        continue;
      }
      ++covered;
      ASSERT_LE(ray.head<2>().norm(), 1.001 * most);
      const Eigen::Vector2d back = camera.project(ray * 1.3);
      ASSERT_NEAR(back.x(), u, 1e-6) << "pixel " << u << ", " << v;
      ASSERT_NEAR(back.y(), v, 1e-6) << "pixel " << u << ", " << v;
    }
  }
  EXPECT_GT(covered, 3000);
  EXPECT_FALSE(camera.ray(0, 0).allFinite());
  EXPECT_GT(beyond, 100);
}

TEST(Camera, ProjectIsNotANumberWhereTheRationalModelFoldsBack) {
  // (1 + 0.1 s) / (1 + s^2): the distorted radius falls from about 0.8 on.
  const CameraIntrinsics camera = with_distortion({0.1, 0, 0, 0, 0, 0, 1.0, 0});
  EXPECT_TRUE(camera.project({0.5, 0, 1}).allFinite());
  EXPECT_FALSE(camera.project({2.0, 0, 1}).allFinite());
  const auto lens = lens_as<float>(camera.lens());
  float before = 0.0f;
  for (float r = 0.1f; r < 20.0f; r += 0.1f) {
    float x = r, y = 0.0f;
    distort_rational(lens, x, y);
    EXPECT_GT(x, before);
    before = x;
  }
}

TEST(Camera, RayTableHoldsTheRaysRowByRow) {
  CameraIntrinsics camera = with_distortion(kMild);
  camera.width = 4;
  camera.height = 3;
  const RayTable table(camera);
  ASSERT_EQ(table.x().size(), 12u);
  ASSERT_EQ(table.y().size(), 12u);
  const Vec3d ray = camera.ray(3, 1);
  EXPECT_EQ(table.x()[7], float(ray.x()));
  EXPECT_EQ(table.y()[7], float(ray.y()));
}

TEST(Camera, CheckAcceptsAPlainOne) {
  EXPECT_TRUE(pinhole().check());
  EXPECT_TRUE(with_distortion(kMild).check());
}

template <class Change>
void expect_refused(const Change& change) {
  CameraIntrinsics camera = pinhole();
  change(camera);
  const Result<> r = camera.check();
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, ErrorCode::kFormat);
}

TEST(Camera, CheckRefusesWhatNoCameraHas) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused([](CameraIntrinsics& c) { c.width = 0; });
  expect_refused([](CameraIntrinsics& c) { c.height = -1; });
  expect_refused([](CameraIntrinsics& c) { c.width = 65536; });
  expect_refused([](CameraIntrinsics& c) { c.fx = 0.0; });
  expect_refused([](CameraIntrinsics& c) { c.fy = -365.0; });
  expect_refused([=](CameraIntrinsics& c) { c.fx = nan; });
  expect_refused([=](CameraIntrinsics& c) { c.cy = nan; });
  expect_refused([=](CameraIntrinsics& c) { c.distortion[4] = nan; });
}

}  // namespace
}  // namespace turnscan
