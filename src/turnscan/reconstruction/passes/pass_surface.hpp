#pragma once
// What one pass, one way in which the object lay, tells about where it is: the surface that was
// measured, and the space that was seen to be empty.

#include <memory>
#include <optional>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::passes {

/// Objects on one table are seen by the same views.
using SharedViews = std::shared_ptr<const std::vector<views::DepthView>>;

/// One object of a pass. Table frame of the pass, metres.
struct PassSurface {
  std::vector<Vec3f> points;   ///< of the surface; only what was measured
  std::vector<Vec3f> normals;  ///< unit, outwards; one a point
  std::vector<float> areas;    ///< m^2 that each point stands for
  std::vector<float> weights;  ///< of the measurements behind each point, relative, (0, 1]
  /// Lightness (halved) and two opponent colours, as logarithms of the light that comes back; NaN
  /// where not known. See surface_colors(). Empty: there is no colour.
  std::vector<Vec3f> colors;
  SharedViews views;              ///< some or all of the pass; may be none
  std::optional<double> floor_m;  ///< height below which there is only the platter
  double noise_m = 0.0015;        ///< of a depth along its ray
  double spacing_m = 0.0;         ///< of the points of one frame
  bool filtered = false;          ///< the sensor averages over its pixels
};

/// Fails with kTooFewPoints when it has fewer than 200 points; throws std::invalid_argument when
/// normals, areas, weights or colours do not fit them.
Result<> check_surface(const PassSurface& surface);

/// The vertices of a reconstructed object that were measured and lie at least two edges away from
/// what was not. Without views, floor and noise.
PassSurface measured_surface(const ObjectResult& object);
/// With them, from what its reconstruction for placing saw (Reconstruction::seen).
PassSurface measured_surface(const ObjectResult& object,
                             const std::shared_ptr<const SeenSpace>& seen);

}  // namespace turnscan::passes
