#pragma once
// The ways in which a body stands on a plane by itself.

#include <optional>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

struct RestingPose {
  Vec3d down = -Vec3d::UnitY();  ///< unit, in the mesh's frame: points to the plane it stands on
  double center_height_m = 0.0;  ///< of the centre of mass above the plane
  /// How far the centre of mass has to be lifted before the body is tilted by 15 degrees, along the
  /// way on which that takes least: a lower bound. (It may rock below that.)
  double lift_m = 0.0;
};

struct RestingOptions {
  double min_lift_m = 0.0002;  ///< what takes less rolls or falls
  double least_apart_rad =
      0.26179939;  ///< 15 deg; of two poses that differ by less the lower stays
};

/// Centre of mass of the volume that a closed mesh encloses, of one density throughout. The middle
/// of its box where that volume is not positive.
Vec3d center_of_mass(const TriangleMesh& mesh);

/// The horizontal direction (unit, y = 0) in which a body tips over that touches a level plane at
/// some points: the middle of their widest gap, as seen from its centre of mass; without points it
/// is arbitrary. nullopt where the centre lies above their convex hull, or within tolerance_m of
/// being above one of them.
std::optional<Vec3d> tipping_direction(const Vec3d& center_of_mass, std::span<const Vec3f> contacts,
                                       double tolerance_m);

/// The lowest first. A body rests on those faces of its convex hull to which its centre of mass
/// projects; on a ball, or the round side of a cylinder, it rolls, and such are left out. Empty
/// where nothing stands, and for a mesh without volume. Deterministic.
std::vector<RestingPose> resting_poses(const TriangleMesh& mesh,
                                       const RestingOptions& options = {});

}  // namespace turnscan
