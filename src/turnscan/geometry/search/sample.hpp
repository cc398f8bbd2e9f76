#pragma once
// Points drawn uniformly from a surface.

#include <cstdint>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

struct SurfaceSamples {
  std::vector<Vec3f> points;             ///< metres, on the mesh
  std::vector<Vec3f> normals;            ///< unit normals of the triangles, by vertex order
  std::vector<std::uint32_t> triangles;  ///< the triangle that contains each point
  double area_m2 = 0.0;                  ///< of the mesh: a sample represents area_m2 / count

  std::size_t size() const { return points.size(); }
};

/// Draws `count` points, uniformly distributed over the area. The i-th is a pure function of (mesh,
/// count, seed, i). Sampling along the area is stratified: any part of the surface that is
/// contiguous in triangle order gets its share to within one point.
/// Fails with kFormat as validate_mesh does, with kTooFewPoints if the mesh has no area, and when
/// cancelled.
Result<SurfaceSamples> sample_surface(const TriangleMesh& mesh, std::size_t count,
                                      std::uint64_t seed, const RunContext& context = {});

}  // namespace turnscan
