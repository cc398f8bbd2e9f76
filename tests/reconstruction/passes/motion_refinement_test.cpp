#include <gtest/gtest.h>

#include <numbers>
#include <tests/reconstruction/passes/lumpy_object.hpp>
#include <turnscan/reconstruction/passes/motion_refinement.hpp>

namespace turnscan::passes {
namespace {

using namespace turnscan::testing;

Eigen::Matrix3d turned(const Vec3d& axis, double degrees) {
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized())
      .toRotationMatrix();
}

/// An object as it lay in two passes, and where the second is in the first's frame.
struct TwoPasses {
  PassSurface first, second;
  Pose truth;

  TwoPasses(const RadiusOf& radius, const RadiusOf& other, const Eigen::Matrix3d& tip) {
    const TriangleMesh object = star_mesh(radius), another = star_mesh(other);
    const Pose standing = set_down(object, Eigen::Matrix3d::Identity());
    const Pose lying = set_down(another, tip);
    first = pass_of(object, standing, 5e-5, 1);
    second = pass_of(another, lying, 5e-5, 2);
    truth = standing * lying.inverse();
  }
  /// As somebody would click it: some millimetres and degrees beside.
  Pose beside(const Eigen::Matrix3d& turn, const Vec3d& shift_m) const {
    const Vec3d center = bounds(first.points).center();
    Pose error = Pose::Identity();
    error.linear() = turn;
    error.translation() = center + shift_m - turn * center;
    return error * truth;
  }
  RefinedMotion refined(const Pose& start) const {
    const PlacedSurface placed{&first, Pose::Identity()};
    auto motion = refine_motion({&placed, 1}, second, start, {}, {});
    EXPECT_TRUE(motion.has_value());
    return motion ? *motion : RefinedMotion();
  }
  double error_m(const Pose& T) const {
    double sum = 0.0;
    for (const Vec3f& p : second.points)
      sum += (T * p.cast<double>() - truth * p.cast<double>()).squaredNorm();
    return std::sqrt(sum / double(second.points.size()));
  }
};

TEST(RefineMotion, FindsTheTruthFromWhereSomebodyClicked) {
  const TwoPasses passes(lumpy_radius, lumpy_radius, turned(Vec3d(1, 0, 0.3), 100.0));
  const Pose start = passes.beside(turned(Vec3d(1, 2, -1), 5.0), Vec3d(0.003, -0.004, 0.002));
  ASSERT_GT(passes.error_m(start), 0.005);
  const RefinedMotion motion = passes.refined(start);
  EXPECT_EQ(motion.misfit, "");
  EXPECT_LT(passes.error_m(motion.T_here_pass), 5e-5);
  EXPECT_GT(motion.overlap_m2, 0.005);
}

TEST(RefineMotion, LeavesTheTurnOfAVaseNearlyAsItWasPut) {
  const TwoPasses passes(vase_radius, vase_radius, turned(Vec3d(1, 0, 0), 90.0));
  const Eigen::Matrix3d spin = turned(Vec3d::UnitY(), 4.0);  // about its axis
  const RefinedMotion motion = passes.refined(
      passes.beside(turned(Vec3d(1, 0, 1), 3.0) * spin, Vec3d(0.003, 0.002, -0.003)));
  EXPECT_EQ(motion.misfit, "");
  const Pose error = motion.T_here_pass * passes.truth.inverse();
  // The axis is where it was, and what was turned about it is still, but for what the shift adds.
  const Vec3d axis = error.linear() * Vec3d::UnitY();
  EXPECT_LT(axis.cross(Vec3d::UnitY()).norm(), 0.003);
  const Eigen::AngleAxisd left(error.linear());
  EXPECT_NEAR(left.angle() * 180.0 / std::numbers::pi, 4.0, 2.0);
}

TEST(RefineMotion, SaysThatAnotherObjectDoesNotFit) {
  const auto other = [](const Vec3d& d) {
    return 1.3 * lumpy_radius({d.z(), -d.x(), d.y() + 0.3});
  };
  const TwoPasses passes(lumpy_radius, other, turned(Vec3d(1, 0, 0), 60.0));
  EXPECT_NE(passes.refined(passes.truth).misfit, "");
}

}  // namespace
}  // namespace turnscan::passes
