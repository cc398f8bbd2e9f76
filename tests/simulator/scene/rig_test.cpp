#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/scene/rig.hpp>

#include "tests/simulator/shapes.hpp"

namespace turnscan {
namespace {

Pose pose_of(const ScannerPlacement& p, double travelled = 0.5) {
  return scanner_pose(p, 0.1, travelled, Vec3d::UnitY());
}

void expect_near(const Vec3d& a, const Vec3d& b, double margin = 1e-12) {
  EXPECT_NEAR((a - b).norm(), 0.0, margin) << a.transpose() << " and " << b.transpose();
}

TEST(ScannerPose, LooksAtItsPointFromItsDistance) {
  ScannerPlacement p;
  p.azimuth_rad = 70.0 * kRadiansPerDegree;
  p.elevation_rad = 30.0 * kRadiansPerDegree;
  p.distance_m = 0.8;
  p.aim_x_m = 0.02;
  p.aim_z_m = -0.03;
  const Pose T = pose_of(p);
  expect_near(T * Vec3d(0, 0, 0.8), {0.02, 0.1, -0.03});
  EXPECT_NEAR(T.translation().y() - 0.1, 0.4, 1e-12);
  // Its x axis is level, its y axis points down.
  EXPECT_NEAR(T.linear()(1, 0), 0.0, 1e-12);
  EXPECT_LT(T.linear()(1, 1), 0.0);
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
}

TEST(ScannerPose, StandsOnMinusZAndGoesCounterClockwise) {
  ScannerPlacement p;
  p.elevation_rad = 0.0;
  expect_near(pose_of(p).translation(), {0, 0.1, -0.9});
  p.azimuth_rad = 90.0 * kRadiansPerDegree;  // seen from above -Z goes to -X
  expect_near(pose_of(p).translation(), {-0.9, 0.1, 0});
}

TEST(ScannerPose, RollsClockwiseSeenFromBehind) {
  ScannerPlacement p;
  const Vec3d right = pose_of(p).linear().col(0), down = pose_of(p).linear().col(1);
  p.roll_rad = 90.0 * kRadiansPerDegree;
  const Pose T = pose_of(p);
  expect_near(T.linear().col(0), down);
  expect_near(T.linear().col(1), -right);
  expect_near(T * Vec3d(0, 0, 0.9), {0, 0.1, 0});
}

TEST(ScannerPose, PansToItsRightAndTiltsUp) {
  ScannerPlacement p;
  p.elevation_rad = 0.0;
  const Pose ahead = scanner_pose(p, 0.1, 0.5, Vec3d::UnitY());
  p.pan_rad = 0.2;
  Pose turned = scanner_pose(p, 0.1, 0.5, Vec3d::UnitY());
  EXPECT_NEAR((ahead.inverse() * turned).linear().col(2).x(), std::sin(0.2), 1e-12);
  EXPECT_EQ(turned.translation(), ahead.translation());
  p.pan_rad = 0.0;
  p.tilt_rad = 0.2;
  turned = scanner_pose(p, 0.1, 0.5, Vec3d::UnitY());
  EXPECT_NEAR(turned.linear().col(2).y(), std::sin(0.2), 1e-12);
}

TEST(ScannerPose, TravelsEvenlyAndIsInItsPlaceHalfway) {
  ScannerPlacement p;
  p.travel_m = 0.2;
  p.roll_rad = 0.3;
  ScannerPlacement still = p;
  still.travel_m = 0.0;
  expect_near(pose_of(p, 0.5).translation(), pose_of(still).translation());
  const Vec3d axis = Vec3d(0.1, 1.0, 0.0).normalized();
  const auto way = [&] {
    return Vec3d(scanner_pose(p, 0.1, 1.0, axis).translation() -
                 scanner_pose(p, 0.1, 0.0, axis).translation());
  };
  expect_near(way(), 0.2 * axis);
  p.travel_along = TravelAlong::kAcross;
  still.roll_rad = 0.0;
  expect_near(way(), 0.2 * pose_of(still).linear().col(0));
  EXPECT_TRUE(pose_of(p, 0.0).linear().isApprox(pose_of(p, 1.0).linear()));
}

TEST(TablePose, LeansToWhereItsDirectionSays) {
  TablePlacement p;
  EXPECT_TRUE(table_pose(p).isApprox(Pose::Identity(), 0.0));
  p.x_m = 0.01;
  p.y_m = 0.02;
  p.tilt_rad = 2.0 * kRadiansPerDegree;
  Pose T = table_pose(p);
  expect_near(T.translation(), {0.01, 0.02, 0});
  // Azimuth 0 is -Z: the top of the axis goes there.
  expect_near(T.linear().col(1), {0, std::cos(p.tilt_rad), -std::sin(p.tilt_rad)});
  p.tilt_direction_rad = 90.0 * kRadiansPerDegree;
  T = table_pose(p);
  expect_near(T.linear().col(1), {-std::sin(p.tilt_rad), std::cos(p.tilt_rad), 0});
}

TEST(CanonicalYaw, GivesTheFrameThatAxisAndCentreGive) {
  for (const double azimuth : {-170.0, -20.0, 0.0, 90.0, 133.0}) {
    ScannerPlacement scanner;
    scanner.azimuth_rad = azimuth * kRadiansPerDegree;
    scanner.roll_rad = 0.4;
    scanner.aim_x_m = 0.03;
    TablePlacement table;
    table.x_m = -0.02;
    table.tilt_rad = 3.0 * kRadiansPerDegree;
    table.tilt_direction_rad = 1.0;
    const Pose T_table = table_pose(table), T_sensor = pose_of(scanner);
    const Pose T =
        (T_table * rotation_about_y(canonical_yaw(T_table, T_sensor))).inverse() * T_sensor;
    const Vec3d axis = T.linear().transpose() * Vec3d::UnitY();
    const Vec3d centre = T.inverse().translation();
    expect_near(T.linear() * axis.cross(centre).normalized(), Vec3d::UnitX(), 1e-9);
    EXPECT_NEAR(T.translation().x(), 0.0, 1e-12);
    EXPECT_LT(T.translation().z(), 0.0);
  }
}

TEST(CanonicalYaw, IsNothingForAScannerOnTheAxis) {
  Pose above = Pose::Identity();
  above.translation().y() = 1.0;
  EXPECT_EQ(canonical_yaw(Pose::Identity(), above), 0.0);
}

TEST(RigOptions, RefuseValuesOutsideTheirRange) {
  ScannerPlacement p;
  EXPECT_TRUE(describe(p).check());
  p.distance_m = std::nan("");
  EXPECT_FALSE(describe(p).check());
  p = {};
  p.elevation_rad = 2.0;
  EXPECT_FALSE(describe(p).check());
  TablePlacement t;
  EXPECT_TRUE(describe(t).check());
  t.tilt_rad = -0.1;
  EXPECT_FALSE(describe(t).check());
}

TEST(ScannerKnock, PushesAndTurnsAsTheScannerSeesIt) {
  ScannerKnock knock;
  EXPECT_FALSE(knock.happens());
  EXPECT_TRUE(knock_pose(knock).isApprox(Pose::Identity(), 0.0));
  knock.shift_m = 0.01;
  expect_near(knock_pose(knock).translation(), {0.01, 0, 0});
  knock.direction_rad = 90.0 * kRadiansPerDegree;  // up is -y
  expect_near(knock_pose(knock).translation(), {0, -0.01, 0});
  knock.pan_rad = 0.1;
  expect_near(knock_pose(knock).linear().col(2), {std::sin(0.1), 0, std::cos(0.1)});
  knock.pan_rad = 0.0;
  knock.tilt_rad = 0.1;
  expect_near(knock_pose(knock).linear().col(2), {0, -std::sin(0.1), std::cos(0.1)});
}

TEST(ScannerKnock, RefusesValuesOutsideTheirRange) {
  const auto refused = [](double ScannerKnock::*field, double value, const std::string& name) {
    ScannerPlacement p;
    p.knock.*field = value;
    const auto checked = describe(p).check();
    ASSERT_FALSE(checked) << name;
    EXPECT_EQ(checked.error().message.find(name + " = "), 0u) << checked.error().message;
  };
  for (const double bad : {-2.0, std::nan("")}) {
    refused(&ScannerKnock::at_s, bad, "knock-at");
    refused(&ScannerKnock::shift_m, bad, "knock");
    refused(&ScannerKnock::direction_rad, 4.0 * bad, "knock-direction");
    refused(&ScannerKnock::pan_rad, bad, "knock-pan");
    refused(&ScannerKnock::tilt_rad, bad, "knock-tilt");
  }
}

}  // namespace
}  // namespace turnscan
