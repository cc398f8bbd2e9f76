#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/geometry/estimation/se3.hpp>

namespace turnscan::estimation {
namespace {

Twist random_twist(std::uint64_t i) {
  Twist out;
  for (int k = 0; k < 6; ++k) out[k] = 0.5 * standard_normal(hash_key(3, i, std::uint64_t(k)));
  return out;
}

const Vec3d kCenter(0.3, -0.2, 0.9);

TEST(Se3, TheLogarithmIsTheInverseOfTheExponential) {
  for (std::uint64_t i = 0; i < 200; ++i) {
    const Twist twist = random_twist(i);
    EXPECT_LT((log_about(kCenter, exp_about(kCenter, twist)) - twist).norm(), 1e-12);
    EXPECT_LT((log_about(kCenter, exp_about(kCenter, twist, 0.7), 0.7) - twist).norm(), 1e-12);
  }
}

TEST(Se3, TheExponentialOfAPureTurnLeavesTheCentre) {
  Twist twist = random_twist(1);
  twist.tail<3>().setZero();
  const Pose motion = exp_about(kCenter, twist);
  EXPECT_LT((motion * kCenter - kCenter).norm(), 1e-15);
  EXPECT_LT((motion.linear().transpose() * motion.linear() - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
}

TEST(Se3, TheExponentialTurnsByTheLengthOfTheRotationVector) {
  const Vec3d turn(0.2, 0.1, -0.4);
  const Eigen::Matrix3d R = exp_so3(turn);
  EXPECT_LT((R * turn - turn).norm(), 1e-15);
  EXPECT_NEAR(std::acos(0.5 * (R.trace() - 1.0)), turn.norm(), 1e-12);
}

TEST(Se3, TheExponentialIsToFirstOrderTheCrossProduct) {
  Twist twist = 1e-5 * random_twist(2);
  const Vec3d p(0.1, 0.4, -0.3);
  const Vec3d moved = p + twist.head<3>().cross(p - kCenter) + twist.tail<3>();
  EXPECT_LT((exp_about(kCenter, twist) * p - moved).norm(), 1e-9);
}

TEST(Se3, NoTwistIsTheIdentity) {
  EXPECT_EQ(exp_about(kCenter, Twist::Zero()).matrix(), Pose::Identity().matrix());
  EXPECT_EQ(log_about(kCenter, Pose::Identity()), Twist(Twist::Zero()));
}

TEST(Se3, AnOrthonormalisedPoseIsARotationNearTheOneBefore) {
  Pose pose = exp_about(kCenter, random_twist(3));
  const Pose before = pose;
  pose.linear() *= 1.0 + 1e-6;
  const Pose after = orthonormalised(pose);
  EXPECT_LT((after.linear().transpose() * after.linear() - Eigen::Matrix3d::Identity()).norm(),
            1e-14);
  EXPECT_LT((after.linear() - before.linear()).norm(), 1e-5);
  EXPECT_EQ(after.translation(), before.translation());
}

}  // namespace
}  // namespace turnscan::estimation
