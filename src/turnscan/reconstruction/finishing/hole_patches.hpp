#pragma once
// Connected unmeasured parts of a mesh.

#include <turnscan/reconstruction/result.hpp>

namespace turnscan::finishing {

/// One edge-connected component of the unmeasured triangles.
struct HolePatch {
  std::vector<std::uint32_t> triangles;  ///< ascending
  double size_m = 0.0;                   ///< longest side of its bounding box
  double area_m2 = 0.0;
};

/// In the order of their first triangles. evidence has one entry per triangle.
std::vector<HolePatch> find_hole_patches(const TriangleMesh& mesh,
                                         const std::vector<Evidence>& evidence);

}  // namespace turnscan::finishing
