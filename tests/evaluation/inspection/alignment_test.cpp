#include <gtest/gtest.h>

#include <numbers>
#include <turnscan/evaluation/inspection/alignment.hpp>

#include "tests/geometry/shapes.hpp"

namespace turnscan {
namespace {

using namespace turnscan::test;

/// No two of its sides are alike.
TriangleMesh lump() {
  TriangleMesh mesh = sphere(0.03, 4);
  for (Vec3f& p : mesh.vertices) {
    const Vec3f d = p.normalized();
    p = p.cwiseProduct(Vec3f(1.0f, 0.8f, 0.6f)) + 0.004f * d.x() * d.y() * Vec3f(0, 1, 2) +
        0.003f * std::max(0.0f, d.z()) * d;
  }
  return mesh;
}

TEST(Alignment, BringsAModelBackToWhereItWas) {
  const TriangleMesh reference = lump();
  for (std::uint64_t i = 0; i < 5; ++i) {
    const Vec3d axis(random_value(1, i, 0), random_value(1, i, 1), random_value(1, i, 2));
    Pose away = Pose::Identity();
    away.rotate(Eigen::AngleAxisd(0.08, axis.normalized()));
    away.pretranslate(Vec3d(0.001, -0.0015, 0.0005) * double(i));
    PointCloud cloud;
    cloud.points = reference.vertices;
    const auto made = align_to(moved(cloud, away).points, reference, {});
    ASSERT_TRUE(made) << made.error().text();
    EXPECT_LT(made->rms_after_m, 2e-6);
    EXPECT_GT(made->rms_before_m, 1e-4);
    EXPECT_NEAR(made->turned_rad, 0.08, 1e-3);
    const Pose both = made->icp.T_target_source * away;
    EXPECT_LT((both.matrix() - Pose::Identity().matrix()).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_NE(alignment_text(*made).find("turned 4.58"), std::string::npos)
        << alignment_text(*made);
  }
}

TEST(Alignment, SaysWhichDirectionsAShapeDoesNotDetermine) {
  const TriangleMesh table = plane(20, 0.1);
  PointCloud cloud;
  cloud.points = table.vertices;
  Pose away = Pose::Identity();
  away.pretranslate(Vec3d(0, 0, 0.001));
  const auto made = align_to(moved(cloud, away).points, table, {});
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_EQ(made->icp.held_directions, 3);
  EXPECT_NEAR(made->moved_m, 0.001, 1e-6);
  EXPECT_NE(alignment_text(*made).find("3 of 6"), std::string::npos);
}

TEST(Alignment, OfSomethingFarAwayIsRefused) {
  const TriangleMesh reference = lump();
  PointCloud cloud;
  cloud.points = reference.vertices;
  Pose away = Pose::Identity();
  away.pretranslate(Vec3d(1.0, 0, 0));
  EXPECT_FALSE(align_to(moved(cloud, away).points, reference, {}));
}

}  // namespace
}  // namespace turnscan
