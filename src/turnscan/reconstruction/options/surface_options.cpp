#include <turnscan/reconstruction/options/surface_options.hpp>

namespace turnscan {

OptionTable describe(SurfaceOptions& o) {
  OptionTable table;
  table
      .choice("method", o.method, {"poisson", "concave-hull", "volumetric"},
              "Surface: volumetric (signed distances of all frames, with what their rays passed "
              "through), or from points: Poisson (smooth, closed) or concave hull (alpha shape)")
      .number("poisson-depth", o.poisson_depth, {2, 13}, "Depth of Poisson's octree")
      .number("poisson-samples", o.samples_per_node, Quantity::kNone, {1.0, 100.0},
              "Samples per node of Poisson's octree; noisy candidates need 3 to 5")
      .number("poisson-scale", o.poisson_scale, Quantity::kNone, {1.0, 10.0},
              "Poisson's cube relative to the bounding cube of the points")
      .number("poisson-point-weight", o.point_weight, Quantity::kNone, {0.0, 100.0},
              "Weight of the points in screened Poisson; 0 is the unscreened method")
      .number("alpha", o.alpha_m, Quantity::kLength, {1e-5, 1.0},
              "Concave hull's alpha; automatic: from the spacing of the candidates")
      .flag("repair", o.repair, "Make each mesh closed, 2-manifold and outward");
  return table;
}

}  // namespace turnscan
