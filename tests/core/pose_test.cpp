#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <turnscan/core/pose.hpp>

namespace turnscan {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

void expect_refused(const Result<Pose>& pose) {
  ASSERT_FALSE(pose);
  EXPECT_EQ(pose.error().code, ErrorCode::kFormat);
}

TEST(PoseFromQuaternion, TurnsCounterClockwiseForPositiveAngles) {
  const double h = std::sqrt(0.5);  // 90 deg about z
  const Pose pose = pose_from({1, 2, 3}, 0, 0, h, h).value();
  EXPECT_TRUE((pose * Vec3d(1, 0, 0)).isApprox(Vec3d(1, 3, 3)));
}

TEST(PoseFromQuaternion, NormalisesAnyLength) {
  const Pose unit = pose_from(Vec3d::Zero(), 0.5, 0.5, 0.5, 0.5).value();
  EXPECT_TRUE(pose_from(Vec3d::Zero(), 7, 7, 7, 7).value().isApprox(unit));
  EXPECT_TRUE(pose_from(Vec3d::Zero(), -1e-5, -1e-5, -1e-5, -1e-5).value().isApprox(unit));
}

TEST(PoseFromQuaternion, RefusesWhatIsNotAPose) {
  expect_refused(pose_from(Vec3d::Zero(), 0, 0, 0, 0));
  expect_refused(pose_from(Vec3d::Zero(), 0, kNan, 0, 1));
  expect_refused(pose_from(Vec3d::Zero(), 0, kInf, 0, 1));
  expect_refused(pose_from({kNan, 0, 0}, 0, 0, 0, 1));
  expect_refused(pose_from(Vec3d::Zero(), 1e200, 1e200, 0, 1));  // its length overflows
}

TEST(PoseFromMatrix, TakesARigidTransform) {
  const Pose pose = Eigen::Translation3d(0.1, -0.2, 0.3) * rotation_about_y(0.7);
  EXPECT_TRUE(pose_from(pose.matrix()).value().isApprox(pose, 1e-14));
}

TEST(PoseFromMatrix, OrthonormalisesARotationOfFewDigits) {
  Eigen::Matrix4d rounded = rotation_about_y(0.7).matrix();
  for (double& x : rounded.reshaped()) x = std::round(x * 1e4) / 1e4;
  const Eigen::Matrix3d r = pose_from(rounded).value().linear();
  EXPECT_LT((r * r.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

TEST(PoseFromMatrix, RefusesWhatIsNotAPose) {
  const Eigen::Matrix4d identity = Eigen::Matrix4d::Identity();
  Eigen::Matrix4d m = identity;
  m(3, 0) = 0.1;  // last row
  expect_refused(pose_from(m));
  m = identity;
  m(0, 0) = -1;  // mirrored
  expect_refused(pose_from(m));
  m = identity;
  m(1, 1) = 1.01;  // scaled
  expect_refused(pose_from(m));
  m = identity;
  m(0, 3) = kNan;
  expect_refused(pose_from(m));
  m = identity;
  m.topLeftCorner<3, 3>() << 1e200, -1e200, 0, 1e200, 1e200, 0, 0, 0, 1;  // inf - inf
  expect_refused(pose_from(m));
  expect_refused(pose_from(Eigen::Matrix4d(Eigen::Matrix4d::Zero())));
}

TEST(RotationAboutY, IsCounterClockwiseSeenFromAbove) {
  // Seen from +Y with Z to the right, X points up: z turns to x.
  const Pose quarter = rotation_about_y(std::numbers::pi / 2);
  EXPECT_TRUE((quarter * Vec3d::UnitZ()).isApprox(Vec3d::UnitX()));
  EXPECT_TRUE((quarter * Vec3d::UnitY()).isApprox(Vec3d::UnitY()));
}

}  // namespace
}  // namespace turnscan
