#pragma once
// Meshes a signed distance function. The simulator's own: its objects must not depend on the tools
// that it judges.

#include <functional>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::objects {

/// About the distance to the surface in metres, negative inside; steepness at most 1.5.
using SignedDistance = std::function<float(const Vec3f&)>;

struct ImplicitGrid {
  Vec3f min = Vec3f::Zero();  ///< the surface lies well inside [min, max]
  Vec3f max = Vec3f::Zero();
  float cell = 0.001f;  ///< metres
  int smoothing = 3;    ///< rounds of moving vertices along the surface to even out triangles
};

/// Closed, 2-manifold, outward triangles with their vertices on the zero set, and its normals.
/// Marching cubes (Lorensen and Cline 1987) with a table made from one rule for faces: corners
/// inside are connected only along edges. Neighbouring cells then always agree, and no diagonal
/// within a cell joins two edges of one face, so that no edge is used twice. Fails with kCancelled.
Result<TriangleMesh> mesh_of(const SignedDistance& distance, const ImplicitGrid& grid,
                             const RunContext& context = {});

}  // namespace turnscan::objects
