#pragma once
// Data of one pass, recorded in one pose of the object, for registration: the measured surface and
// the observed free space.

#include <memory>
#include <optional>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::passes {

/// Objects on one table share the views.
using SharedViews = std::shared_ptr<const std::vector<views::DepthView>>;

/// One object of a pass. Table frame of the pass, metres.
struct PassSurface {
  std::vector<Vec3f> points;   ///< of the surface; only measured ones
  std::vector<Vec3f> normals;  ///< unit, outwards; one per point
  std::vector<float> areas;    ///< m^2 that each point represents
  std::vector<float> weights;  ///< of the measurements behind each point, relative, (0, 1]
  /// Lightness (halved) and two opponent colours, as logarithms of the reflected light; NaN if not
  /// known. See surface_colors(). Empty: there is no colour.
  std::vector<Vec3f> colors;
  SharedViews views;              ///< some or all of the pass; may be none
  std::optional<double> floor_m;  ///< height below which there is only the platter
  double noise_m = 0.0015;        ///< of a depth value along its ray
  double spacing_m = 0.0;         ///< of the points of one frame
  bool filtered = false;          ///< the sensor averages over neighbouring pixels
};

/// Fails with kTooFewPoints if it has fewer than 200 points; throws std::invalid_argument if the
/// sizes of normals, areas, weights or colours do not match them.
Result<> check_surface(const PassSurface& surface);

/// The measured vertices of a reconstructed object that are at least two edges away from unmeasured
/// surface. Without views, floor and noise.
PassSurface measured_surface(const ObjectResult& object);
/// The same with views, floor and noise, from Reconstruction::seen of a reconstruction for placing.
PassSurface measured_surface(const ObjectResult& object,
                             const std::shared_ptr<const SeenSpace>& seen);

}  // namespace turnscan::passes
