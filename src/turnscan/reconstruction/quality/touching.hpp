#pragma once
// Detects objects on a platter that may be two touching ones.

#include <optional>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::quality {

/// Section by an upright plane that divides a mesh into two parts, either of which can stand by
/// itself.
struct Neck {
  Vec3d place = Vec3d::Zero();  ///< in the middle of the section
  double area_m2 = 0.0;         ///< of the section
  double share = 0.0;           ///< ratio to the largest parallel section of the smaller side
};

/// The narrowest upright section of a closed mesh (metres, y up, on a platter at y = 0) that leaves
/// on either side at least a tenth of the volume, with its centre of mass above the part that
/// extends down to stands_below_m: a leg does not stand by itself. Sections are step_m apart in 36
/// directions. nullopt if no section is narrower than a quarter of the largest one on either side,
/// and half as large as those 10 mm beside it: objects do not touch along a bar.
std::optional<Neck> narrowest_neck(const TriangleMesh& mesh, double step_m, double stands_below_m);

}  // namespace turnscan::quality
