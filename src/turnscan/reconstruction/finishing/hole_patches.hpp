#pragma once
// Connected parts of a mesh that nothing measured.

#include <turnscan/reconstruction/result.hpp>

namespace turnscan::finishing {

/// One connected part of the triangles that are not measured, neighbours across an edge.
struct HolePatch {
  std::vector<std::uint32_t> triangles;  ///< ascending
  double size_m = 0.0;                   ///< longest side of its box
  double area_m2 = 0.0;
};

/// In the order of their first triangles. evidence has one entry a triangle.
std::vector<HolePatch> find_hole_patches(const TriangleMesh& mesh,
                                         const std::vector<Evidence>& evidence);

}  // namespace turnscan::finishing
