#pragma once
// From oriented candidate points to a mesh: screened Poisson, or concave hull (alpha shape, PCL),
// which runs in a child process so that it can be cancelled at any moment.

#include <turnscan/core/option_table.hpp>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

enum class SurfaceMethod { kPoisson, kConcaveHull, kVolumetric };

struct SurfaceOptions {
  SurfaceMethod method = SurfaceMethod::kVolumetric;
  int poisson_depth = 8;
  double samples_per_node = 1.5;
  double poisson_scale = 1.1;
  double point_weight = 10.0;     ///< refined candidates are worth more than the 4 of raw points
  std::optional<double> alpha_m;  ///< concave hull: largest radius that bridges a gap
  bool repair = true;             ///< make the mesh closed, 2-manifold and outward
};
OptionTable describe(SurfaceOptions& options);

/// Screened Poisson surface (Kazhdan, Bolitho and Hoppe 2006; Kazhdan and Hoppe 2013): the
/// indicator whose gradient follows the normals, 1/2 on the faces of the cube around the points,
/// marched on cells of poisson_depth or coarser ones where the points are not dense enough for it.
/// Closed, 2-manifold and outward. The same bytes for any number of threads. Needs points with
/// normals. Fails with kTooFewPoints (fewer than 10, or all at one place), kLibrary (no surface),
/// kResourceLimit, kCancelled.
Result<TriangleMesh> poisson_surface(const PointCloud& oriented, const SurfaceOptions& options,
                                     const RunContext& context);

/// Concave hull: not 2-manifold by nature.
Result<TriangleMesh> concave_hull(const PointCloud& points, double alpha_m,
                                  const RunContext& context);

}  // namespace turnscan
