#pragma once
// Whether an object on a platter may be two that touch.

#include <optional>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::quality {

/// Where upright planes cut a mesh in two that may each stand by themselves.
struct Neck {
  Vec3d place = Vec3d::Zero();  ///< in the middle of the section
  double area_m2 = 0.0;         ///< of the section
  double share = 0.0;           ///< of the largest parallel section of the lesser side
};

/// The narrowest upright section of a closed mesh (metres, y up, on a platter at y = 0) that leaves
/// on either side a tenth of the volume or more, whose centre of mass lies above what of it reaches
/// down to stands_below_m: a leg does not stand by itself. Sections are step_m apart in 36
/// directions. nullopt where no section is narrower than a quarter of the largest one on either
/// side, and half as large as those 10 mm beside it: a bar is no place where things touch.
std::optional<Neck> narrowest_neck(const TriangleMesh& mesh, double step_m, double stands_below_m);

}  // namespace turnscan::quality
