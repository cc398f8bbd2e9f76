#include <gtest/gtest.h>

#include <turnscan/core/random.hpp>
#include <turnscan/geometry/registration/free_registration.hpp>
#include <vector>

namespace turnscan {
namespace {

/// A bumpy surface of 20 cm.
std::vector<Vec3f> surface() {
  std::vector<Vec3f> points;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    const double x = uniform01(hash_key(1, i, 0)) - 0.5, z = uniform01(hash_key(1, i, 1)) - 0.5;
    points.emplace_back(float(0.2 * x), float(0.02 * std::sin(9 * x) * std::cos(7 * z)),
                        float(0.2 * z));
  }
  return points;
}

TEST(RegisterFreely, UndoesASmallMotionByEitherMethod) {
  const auto target = surface();
  Pose motion = rotation_about_y(0.03);
  motion.translation() = Vec3d(0.001, -0.001, 0.002);
  std::vector<Vec3f> source;
  for (const Vec3f& p : target) source.push_back((motion * p.cast<double>()).cast<float>());
  for (const auto method : {FreeMethod::kIcp, FreeMethod::kGicp}) {
    const auto found = register_freely(source, target, Pose::Identity(), method, 0.02, 100);
    ASSERT_TRUE(found) << found.error().text();
    EXPECT_LT(((*found * motion) * Vec3d(0.1, 0, 0) - Vec3d(0.1, 0, 0)).norm(), 2e-4);
  }
}

TEST(RegisterFreely, RefusesTooFewPoints) {
  const std::vector<Vec3f> few(5, Vec3f::Zero());
  EXPECT_EQ(
      register_freely(few, surface(), Pose::Identity(), FreeMethod::kIcp, 0.01, 10).error().code,
      ErrorCode::kTooFewPoints);
}

}  // namespace
}  // namespace turnscan
