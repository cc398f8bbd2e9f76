#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/scene/rig.hpp>

namespace turnscan {

namespace {

constexpr double kRightAngle = kTurn / 4;

/// About an axis of the sensor's own. Without an angle the pose keeps its bytes.
void turn(Pose& T, double angle_rad, const Vec3d& axis) {
  if (angle_rad != 0.0)
    T.linear() = T.linear() * Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
}

/// Adds to the scanner's table, which lists placement and knock.
void add_knock(OptionTable& table, ScannerKnock& k) {
  table
      .number(
          "knock-at", k.at_s, Quantity::kTime, {0.0, 1e5},
          "When somebody runs into the scanner, if knock, knock-pan or knock-tilt is given. The "
          "recorded calibration is from before.")
      .number("knock", k.shift_m, Quantity::kLength, {0.0, 1.0},
              "How far it is pushed then, across its view; it stays there.")
      .number("knock-direction", k.direction_rad, Quantity::kAngle, {-kTurn, kTurn},
              "To where it is pushed: 0deg to its own right, 90deg up.")
      .number("knock-pan", k.pan_rad, Quantity::kAngle, {-kRightAngle, kRightAngle},
              "By how much it turns to its right then.")
      .number("knock-tilt", k.tilt_rad, Quantity::kAngle, {-kRightAngle, kRightAngle},
              "By how much it turns up then.");
}

}  // namespace

OptionTable describe(ScannerPlacement& p) {
  OptionTable table;
  table
      .number("distance", p.distance_m, Quantity::kLength, {0.01, 100.0},
              "Distance of the scanner from the point it looks at.")
      .number("elevation", p.elevation_rad, Quantity::kAngle,
              {-0.99 * kRightAngle, 0.99 * kRightAngle},
              "Height of the scanner above the horizontal, as an angle.")
      .number("azimuth", p.azimuth_rad, Quantity::kAngle, {-2.0 * kTurn, 2.0 * kTurn},
              "Where the scanner stands around the table, counter-clockwise seen from above.")
      .number("aim-height", p.aim_height_m, Quantity::kLength, {-10.0, 10.0},
              "Height above the platter of the point that the scanner looks at; auto: the middle "
              "of the object.")
      .number("aim-x", p.aim_x_m, Quantity::kLength, {-10.0, 10.0},
              "How far beside the axis that point lies, along X.")
      .number("aim-z", p.aim_z_m, Quantity::kLength, {-10.0, 10.0},
              "How far beside the axis that point lies, along Z.")
      .number("pan", p.pan_rad, Quantity::kAngle, {-kTurn, kTurn},
              "Turn of the scanner to its right, away from that point.")
      .number("tilt", p.tilt_rad, Quantity::kAngle, {-kTurn, kTurn},
              "Turn of the scanner up, away from that point.")
      .number("roll", p.roll_rad, Quantity::kAngle, {-kTurn, kTurn},
              "Turn of the scanner about its viewing axis, clockwise seen from behind it. The line "
              "of a line scanner is upright at 0deg and level at 90deg.")
      .number("travel", p.travel_m, Quantity::kLength, {-100.0, 100.0},
              "How far the scanner moves during the recording, evenly and without turning; halfway "
              "it is where the other options put it.")
      .choice("travel-along", p.travel_along, {"axis", "across"},
              "Where it travels: up along the turntable's axis, or across to its own right.");
  add_knock(table, p.knock);
  return table;
}

OptionTable describe(TablePlacement& p) {
  OptionTable table;
  table
      .number(
          "table-x", p.x_m, Quantity::kLength, {-10.0, 10.0},
          "How far the turntable stands from where the scanners were meant to find it, along X.")
      .number("table-y", p.y_m, Quantity::kLength, {-10.0, 10.0}, "The same upwards.")
      .number("table-z", p.z_m, Quantity::kLength, {-10.0, 10.0}, "The same along Z.")
      .number("table-tilt", p.tilt_rad, Quantity::kAngle, {0.0, 0.5 * kRightAngle},
              "Angle of the turntable's axis against the vertical.")
      .number("table-tilt-direction", p.tilt_direction_rad, Quantity::kAngle,
              {-2.0 * kTurn, 2.0 * kTurn},
              "To where the axis leans, around the table as the azimuth of a scanner.");
  return table;
}

Pose scanner_pose(const ScannerPlacement& p, double aim_height_m, double travelled,
                  const Vec3d& axis) {
  const double c = std::cos(p.elevation_rad), s = std::sin(p.elevation_rad);
  const Vec3d aim(p.aim_x_m, p.aim_height_m.value_or(aim_height_m), p.aim_z_m);
  Eigen::Matrix3d look;
  look.col(0) = Vec3d(-1.0, 0.0, 0.0);
  look.col(1) = Vec3d(0.0, -c, -s);
  look.col(2) = Vec3d(0.0, -s, c);
  if (p.azimuth_rad != 0.0) look = rotation_about_y(p.azimuth_rad).linear() * look;
  const Vec3d way = p.travel_along == TravelAlong::kAxis ? axis : Vec3d(look.col(0));
  Pose T = Pose::Identity();
  T.translation() = aim - p.distance_m * look.col(2) + (travelled - 0.5) * p.travel_m * way;
  T.linear() = look;
  turn(T, p.pan_rad, Vec3d::UnitY());
  turn(T, p.tilt_rad, Vec3d::UnitX());
  turn(T, p.roll_rad, Vec3d::UnitZ());
  return T;
}

Pose knock_pose(const ScannerKnock& knock) {
  Pose T = Pose::Identity();
  T.translation() =
      knock.shift_m * Vec3d(std::cos(knock.direction_rad), -std::sin(knock.direction_rad), 0.0);
  T.linear() = (Eigen::AngleAxisd(knock.pan_rad, Vec3d::UnitY()) *
                Eigen::AngleAxisd(knock.tilt_rad, Vec3d::UnitX()))
                   .toRotationMatrix();
  return T;
}

Pose table_pose(const TablePlacement& p) {
  Pose T = Pose::Identity();
  T.translation() = Vec3d(p.x_m, p.y_m, p.z_m);
  if (p.tilt_rad == 0.0) return T;
  // Azimuth 0 is -Z; tilting in that direction is a rotation about -X.
  const Vec3d about = rotation_about_y(p.tilt_direction_rad) * Vec3d(-1.0, 0.0, 0.0);
  T.linear() = Eigen::AngleAxisd(p.tilt_rad, about).toRotationMatrix();
  return T;
}

double canonical_yaw(const Pose& T_world_table, const Pose& T_world_sensor) {
  constexpr double kOnAxis_m = 1e-9;
  const Vec3d p_table = T_world_table.inverse() * T_world_sensor.translation();
  if (std::hypot(p_table.x(), p_table.z()) < kOnAxis_m) return 0.0;
  // In the desired frame the scanner is at x = 0, z < 0.
  return std::atan2(-p_table.x(), -p_table.z());
}

}  // namespace turnscan
