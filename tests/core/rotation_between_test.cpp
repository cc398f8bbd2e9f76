#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/core/rotation_between.hpp>

namespace turnscan {
namespace {

Vec3d random_direction(std::uint64_t i) {
  return Vec3d(standard_normal(hash_key(1, i, 0)), standard_normal(hash_key(1, i, 1)),
               standard_normal(hash_key(1, i, 2)));
}

TEST(RotationBetween, IsThatOfEigenToTheLastBit) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3d a = random_direction(2 * i), b = random_direction(2 * i + 1);
    const Eigen::Quaterniond expected = Eigen::Quaterniond::FromTwoVectors(a, b);
    EXPECT_EQ(rotation_between(a, b).coeffs(), expected.coeffs());
  }
}

TEST(RotationBetween, OfOppositeDirectionsIsThatOfEigenToo) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const Vec3d a = random_direction(i), b = -0.5 * a;
    const Eigen::Quaterniond expected = Eigen::Quaterniond::FromTwoVectors(a, b);
    EXPECT_EQ(rotation_between(a, b).coeffs(), expected.coeffs());
    EXPECT_LT((rotation_between(a, b) * a.normalized() - b.normalized()).norm(), 1e-7);
  }
}

TEST(RotationBetween, OfOneDirectionIsTheIdentity) {
  const Vec3d a(0.2, -0.4, 0.1);
  EXPECT_LT(rotation_between(a, 3.0 * a).angularDistance(Eigen::Quaterniond::Identity()), 1e-7);
}

}  // namespace
}  // namespace turnscan
