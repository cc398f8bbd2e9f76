#pragma once
// Stable resting poses of a body on a plane.

#include <optional>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

struct RestingPose {
  Vec3d down = -Vec3d::UnitY();  ///< unit, in the mesh's frame: towards the plane it rests on
  double center_height_m = 0.0;  ///< of the centre of mass above the plane
  /// Height by which the centre of mass has to be lifted until the body is tilted by 15 degrees, in
  /// the direction that needs least: a lower bound. (It may rock below that.)
  double lift_m = 0.0;
};

struct RestingOptions {
  double min_lift_m = 0.0002;  ///< poses that need less are unstable
  double least_apart_rad =
      0.26179939;  ///< 15 deg; of two poses that differ by less, the lower is kept
};

/// Centre of mass of the volume that a closed mesh encloses, of uniform density. The centre of its
/// bounding box if that volume is not positive.
Vec3d center_of_mass(const TriangleMesh& mesh);

/// The horizontal direction (unit, y = 0) in which a body that touches a level plane at some points
/// tips over: the middle of the widest gap between them, as seen from its centre of mass; arbitrary
/// without points. nullopt if the centre is above their convex hull, or within tolerance_m of being
/// above one of them.
std::optional<Vec3d> tipping_direction(const Vec3d& center_of_mass, std::span<const Vec3f> contacts,
                                       double tolerance_m);

/// Resting poses, the lowest first. A body rests on those faces of its convex hull onto which its
/// centre of mass projects; on a ball, or the round side of a cylinder, it rolls, and such poses
/// are excluded. Empty if there is no stable pose, and for a mesh without volume. Deterministic.
std::vector<RestingPose> resting_poses(const TriangleMesh& mesh,
                                       const RestingOptions& options = {});

}  // namespace turnscan
