#pragma once
// Poses of scanners and turntable. The world's frame: origin at the nominal centre of the platter's
// surface, +Y against gravity.

#include <turnscan/core/frame.hpp>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

enum class TravelAlong {
  kAxis,   ///< up along the turntable's axis
  kAcross  ///< sideways, to the scanner's right without roll
};

/// Somebody bumps into a scanner, which stays displaced.
struct ScannerKnock {
  double at_s = 0.0;           ///< since the first frame
  double shift_m = 0.0;        ///< across its viewing direction
  double direction_rad = 0.0;  ///< of the shift: 0 to its right, 90 deg up
  double pan_rad = 0.0;        ///< to its right
  double tilt_rad = 0.0;       ///< up

  bool happens() const { return shift_m != 0.0 || pan_rad != 0.0 || tilt_rad != 0.0; }
};

struct ScannerPlacement {
  double distance_m = 0.9;                     ///< to the point that it looks at
  double elevation_rad = 0.29670597283903605;  ///< 17 deg above the horizontal
  double azimuth_rad = 0.0;  ///< about the table, counter-clockwise seen from above; 0: on -Z
  std::optional<double> aim_height_m;   ///< of the point it looks at; nullopt: middle of the object
  double aim_x_m = 0.0, aim_z_m = 0.0;  ///< of that point; world
  double pan_rad = 0.0;                 ///< from that point to its right
  double tilt_rad = 0.0;                ///< up
  double roll_rad = 0.0;                ///< about the viewing axis, clockwise seen from behind
  double travel_m = 0.0;                ///< from its first to its last frame
  TravelAlong travel_along = TravelAlong::kAxis;
  ScannerKnock knock;
};

OptionTable describe(ScannerPlacement& placement);

struct TablePlacement {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< of its centre; world
  double tilt_rad = 0.0;                   ///< of its axis against the vertical
  double tilt_direction_rad = 0.0;         ///< in which it tilts, as a scanner's azimuth
};

OptionTable describe(TablePlacement& placement);

/// Pose of a scanner. With roll and azimuth 0 its x axis is -X of the world. travelled is the
/// completed share of its travel, 0 to 1; halfway it is at the given placement. axis: of the
/// turntable, world. aim_height_m is used if the placement has none of its own.
Pose scanner_pose(const ScannerPlacement& placement, double aim_height_m, double travelled,
                  const Vec3d& axis);

/// Maps points from a knocked scanner to its previous frame. It pans about its own y axis after it
/// has tilted about its x axis.
Pose knock_pose(const ScannerKnock& knock);

/// T_world_table with the axis at rest, its X and Z as close to the world's as the tilt allows.
Pose table_pose(const TablePlacement& placement);

/// The rotation about the table's axis after which the table's frame is the one that axis and
/// centre alone determine for the scanner (thesis eq. 3.10: X = axis x centre in its frame), so
/// that a calibration finds the same frame: T_world_table * rotation_about_y(yaw). 0 if the scanner
/// is on the axis.
double canonical_yaw(const Pose& T_world_table, const Pose& T_world_sensor);

}  // namespace turnscan
