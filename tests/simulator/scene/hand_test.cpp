#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/scene/hand.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

HandOptions two_seconds() {
  HandOptions hand;
  hand.at_s = 3.0;
  hand.duration_s = 2.0;
  hand.height_m = 0.2;
  return hand;
}

TEST(Hand, IsThereInItsTimeOnly) {
  const HandOptions hand = two_seconds();
  for (const double t : {0.0, 2.999, 5.0, 9.0}) EXPECT_FALSE(hand_pose(hand, Vec3d::Zero(), t));
  for (const double t : {3.0, 4.0, 4.999}) EXPECT_TRUE(hand_pose(hand, Vec3d::Zero(), t));
  EXPECT_FALSE(HandOptions().happens());
  EXPECT_FALSE(hand_pose({}, Vec3d::Zero(), 0.0));
}

TEST(Hand, ReachesAboveTheCentreAtItsHeight) {
  const Vec3d centre(0.02, 0.01, -0.03);
  const Pose T = *hand_pose(two_seconds(), centre, 4.0);
  EXPECT_LT((T.translation() - (centre + Vec3d(0, 0.2, 0))).norm(), 1e-9);
}

TEST(Hand, ComesFromItsSide) {
  HandOptions hand = two_seconds();
  for (const double azimuth : {0.0, 1.5, -2.0}) {
    hand.direction_rad = azimuth;
    const Vec3d side = rotation_about_y(azimuth) * Vec3d(0, 0, -1);
    const Pose first = *hand_pose(hand, Vec3d::Zero(), 3.0);
    EXPECT_GT(first.translation().dot(side), 1.0);
    // The arm trails on that side.
    EXPECT_NEAR((first.linear() * Vec3d::UnitZ()).dot(side), 1.0, 1e-12);
  }
}

TEST(Hand, MovesWithoutJumps) {
  const HandOptions hand = two_seconds();
  Vec3d last = hand_pose(hand, Vec3d::Zero(), 3.0)->translation();
  double fastest = 0.0;
  for (double t = 3.001; t < 4.999; t += 0.001) {
    const Vec3d here = hand_pose(hand, Vec3d::Zero(), t)->translation();
    fastest = std::max(fastest, (here - last).norm() / 0.001);
    last = here;
  }
  // 1.2 m in 0.6 s, one and a half times as fast in the middle of the way.
  EXPECT_LT(fastest, 3.2);
  EXPECT_GT(fastest, 2.5);
  EXPECT_GT(last.norm(), 1.0);
}

TEST(Hand, HasTheSizeOfAHandAndItsColours) {
  const TriangleMesh mesh = make_hand();
  Box hand;
  for (const Vec3f& p : mesh.vertices)
    if (p.z() < 0.05f) hand.add(p.cast<double>());
  EXPECT_NEAR(hand.size().z(), 0.18, 0.02);
  EXPECT_NEAR(hand.size().x(), 0.13, 0.03);
  EXPECT_EQ(mesh.colors.size(), mesh.vertices.size());
  EXPECT_GT(bounds(mesh.vertices).max.z(), 0.5);  // an arm, not a hand by itself
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) ASSERT_LT(v, mesh.vertices.size());
}

TEST(HandOptionsTest, RefuseValuesOutsideTheirRange) {
  const auto refused = [](const auto& set, const std::string& name) {
    HandOptions hand;
    set(hand);
    const auto checked = describe(hand).check();
    ASSERT_FALSE(checked) << name;
    EXPECT_EQ(checked.error().message.find(name + " = "), 0u) << checked.error().message;
  };
  for (const double bad : {-20.0, std::nan("")}) {
    refused([&](HandOptions& h) { h.at_s = bad; }, "hand-at");
    refused([&](HandOptions& h) { h.duration_s = bad; }, "hand");
    refused([&](HandOptions& h) { h.direction_rad = bad; }, "hand-direction");
    refused([&](HandOptions& h) { h.height_m = bad; }, "hand-height");
  }
}

}  // namespace
}  // namespace turnscan
