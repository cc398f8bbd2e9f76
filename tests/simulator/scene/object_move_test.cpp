#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/scene/object_move.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

const Vec3d kLow(0.01, 0.0, -0.05), kHigh(0.06, 0.1, 0.03);

std::vector<TriangleMesh> box() { return {test::box_mesh(kLow, kHigh)}; }

double lowest(const Pose& T) {
  double low = 1e9;
  const TriangleMesh mesh = box()[0];
  for (const Vec3f& p : mesh.vertices) low = std::min(low, (T * p.cast<double>()).y());
  return low;
}

TEST(ObjectMove, IsNoneUnlessAsked) {
  ObjectMove move;
  move.at_s = 3.0;
  move.direction_rad = 1.0;
  EXPECT_FALSE(move.happens());
  EXPECT_TRUE(moved_objects(move, box()).isApprox(Pose::Identity(), 0.0));
}

TEST(ObjectMove, ShiftsAlongThePlatterToItsDirection) {
  ObjectMove move;
  move.shift_m = 0.006;
  const Vec3d p(0.02, 0.03, 0.01);
  EXPECT_LT((moved_objects(move, box()) * p - (p - Vec3d(0, 0, 0.006))).norm(), 1e-12);
  move.direction_rad = 90.0 * kRadiansPerDegree;  // seen from above -Z goes to -X
  EXPECT_LT((moved_objects(move, box()) * p - (p - Vec3d(0.006, 0, 0))).norm(), 1e-12);
}

TEST(ObjectMove, TurnsAboutItsMiddleCounterClockwiseSeenFromAbove) {
  ObjectMove move;
  move.turn_rad = 90.0 * kRadiansPerDegree;
  const Pose T = moved_objects(move, box());
  const Vec3d middle = 0.5 * (kLow + kHigh);
  EXPECT_LT((T * middle - middle).norm(), 1e-8);
  EXPECT_LT((T.linear() * Vec3d(0, 0, -1) - Vec3d(-1, 0, 0)).norm(), 1e-12);
}

TEST(ObjectMove, TipsToItsDirectionAndStaysOnThePlatter) {
  ObjectMove move;
  move.tip_rad = 10.0 * kRadiansPerDegree;
  move.turn_rad = 0.4;
  for (const double direction : {0.0, 1.0, -2.5}) {
    move.direction_rad = direction;
    const Pose T = moved_objects(move, box());
    const Vec3d towards = rotation_about_y(direction) * Vec3d(0, 0, -1);
    EXPECT_NEAR((T.linear() * Vec3d::UnitY()).dot(towards), std::sin(move.tip_rad), 1e-12);
    EXPECT_NEAR((T.linear() * Vec3d::UnitY()).y(), std::cos(move.tip_rad), 1e-12);
    EXPECT_NEAR(lowest(T), kLow.y(), 1e-8);
  }
}

TEST(ObjectMove, LeavesAnEmptyPlatterAlone) {
  ObjectMove move;
  move.shift_m = 0.1;
  EXPECT_TRUE(moved_objects(move, {}).isApprox(Pose::Identity(), 0.0));
}

TEST(ObjectMoveOptions, RefuseValuesOutsideTheirRange) {
  const auto refused = [](double ObjectMove::*field, double value, const std::string& name) {
    ObjectMove move;
    move.*field = value;
    const auto checked = describe(move).check();
    EXPECT_FALSE(checked) << name;
    if (!checked) {
      EXPECT_EQ(checked.error().message.find(name + " = "), 0u) << checked.error().message;
    }
  };
  refused(&ObjectMove::at_s, -1.0, "object-move-at");
  refused(&ObjectMove::shift_m, -0.1, "object-move");
  refused(&ObjectMove::direction_rad, 20.0, "object-move-direction");
  refused(&ObjectMove::turn_rad, 7.0, "object-move-turn");
  refused(&ObjectMove::tip_rad, -0.1, "object-move-tip");
  for (const auto& [field, name] : {std::pair(&ObjectMove::at_s, "object-move-at"),
                                    {&ObjectMove::shift_m, "object-move"},
                                    {&ObjectMove::direction_rad, "object-move-direction"},
                                    {&ObjectMove::turn_rad, "object-move-turn"},
                                    {&ObjectMove::tip_rad, "object-move-tip"}})
    refused(field, std::nan(""), name);
}

}  // namespace
}  // namespace turnscan
