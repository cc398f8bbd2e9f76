#pragma once

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/options/surface_options.hpp>

namespace turnscan::poisson {

/// Screened Poisson surface (Kazhdan, Bolitho and Hoppe 2006; Kazhdan and Hoppe 2013): the
/// indicator whose gradient follows the normals, 1/2 on the faces of the cube around the points,
/// marched on cells of poisson_depth or coarser ones if the points are not dense enough for it.
/// Closed, 2-manifold and outward. The result is byte-identical for any number of threads. Needs
/// points with normals. Fails with kTooFewPoints (fewer than 10, or all at one position), kLibrary
/// (no surface), kResourceLimit, kCancelled.
Result<TriangleMesh> poisson_surface(const PointCloud& oriented, const SurfaceOptions& options,
                                     const RunContext& context);

}  // namespace turnscan::poisson
