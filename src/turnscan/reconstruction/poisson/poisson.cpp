// Screened Poisson surface reconstruction (Kazhdan, Bolitho and Hoppe 2006; Kazhdan and Hoppe 2013)
// with quadratic B-splines, on bricks near the surface instead of an octree, level after level from
// coarse to fine.

#include <algorithm>
#include <stdexcept>
#include <turnscan/reconstruction/poisson/poisson.hpp>
#include <turnscan/reconstruction/poisson/poisson_surface.hpp>

namespace turnscan::poisson {

Result<TriangleMesh> poisson_surface(const PointCloud& oriented, const SurfaceOptions& options,
                                     const RunContext& context) {
  if (oriented.normals.size() != oriented.size())
    throw std::invalid_argument("poisson_surface: points need normals");
  if (oriented.size() < 10)
    return fail(ErrorCode::kTooFewPoints, "Poisson: {} points are too few", oriented.size());
  const Box box = bounds(oriented.points);
  if (!(box.size().maxCoeff() > 0.0))
    return fail(ErrorCode::kTooFewPoints, "Poisson: all points lie at one place");
  Cube cube;
  cube.side_m = options.poisson_scale * box.size().maxCoeff();
  cube.corner = box.center() - Vec3d::Constant(0.5 * cube.side_m);
  const int depth = std::max(options.poisson_depth, kCoarsest);
  const OrientedSamples samples(oriented, cube, depth, options.samples_per_node);
  TURNSCAN_ASSIGN(OctreeLevels levels, make_levels(samples, context));
  double iso = 0.0;
  for (std::size_t l = 0; l < levels.size(); ++l) {
    TURNSCAN_ASSIGN(iso, solve_level(levels, l, samples, options.point_weight, context));
    if (l + 1 < levels.size()) add_surface_bricks(levels, l, iso);
  }
  const int marched = std::min(depth, samples.deepest() + 1);
  TURNSCAN_ASSIGN(TriangleMesh mesh, indicator_surface(levels, cube, marched, iso, context));
  if (mesh.empty())
    return fail(ErrorCode::kLibrary, "Poisson: the points enclose nothing; check their normals");
  return mesh;
}

}  // namespace turnscan::poisson
