#pragma once
// The motion between two passes as one would find it with Open3D's own classes.

#include <string>
#include <turnscan/reconstruction/passes/pass_surface.hpp>

namespace turnscan::bench {

struct OtherMotion {
  std::string name;
  Pose T_first_pass = Pose::Identity();
  double fitness = 0.0;  ///< share of the points with a partner, as Open3D states it
  double seconds = 0.0;
};

/// FPFH features, then RANSAC and Fast Global Registration, each refined by point-to-plane ICP, as
/// Open3D's tutorial on global registration has it (voxels of 2.5 % of the object, radii of 5 of
/// them), then ICP on all points. Empty where the program was built without Open3D.
std::vector<OtherMotion> open3d_motions(const passes::PassSurface& first,
                                        const passes::PassSurface& pass);

}  // namespace turnscan::bench
