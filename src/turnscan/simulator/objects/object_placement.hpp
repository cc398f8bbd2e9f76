#pragma once
// How the object stands on the platter.

#include <optional>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// In this order: scaled to its height, leant about Z, tipped about X, set down on the platter with
/// its bounding box centred on the axis, turned about Y, moved. (A second pass scans the other side
/// of the same object: tip it by 90 or 180 deg; its size stays.)
struct ObjectPlacement {
  std::optional<double> height_m;  ///< as the file has it, before it is tipped
  double tip_rad = 0.0;            ///< its front (+Z) goes down
  double lean_rad = 0.0;           ///< its right side (+X) goes up
  double yaw_rad = 0.0;            ///< counter-clockwise seen from above
  double x_m = 0.0, z_m = 0.0;     ///< from the axis
};

OptionTable describe(ObjectPlacement& placement);

struct PlacedObject {
  TriangleMesh mesh;  ///< table frame, platter at angle 0
  /// Takes a point of the mesh as it was given, times scale, to the table.
  Pose T_table_object = Pose::Identity();
  double scale = 1.0;
};

/// Fails with kInvalidOption when a value is out of range or a mesh without height is to be scaled
/// to one, with kTooFewPoints when there is no triangle, with kFormat when a triangle names a
/// vertex that does not exist or one that is not finite. Vertices that no triangle names do not
/// count.
Result<PlacedObject> place_object(TriangleMesh mesh, const ObjectPlacement& placement);

}  // namespace turnscan
