#pragma once
// What of a mesh or cloud lies in a part of the screen.

#include <Eigen/Core>
#include <span>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/selection/selection.hpp>
#include <vector>

namespace turnscan {

/// A part of the screen, in pixels: x to the right, y down.
struct ScreenRegion {
  std::vector<Eigen::Vector2d> points;
  /// 0: what the closed outline through the points encloses, by the parity of crossings; else the
  /// stroke of a brush of this radius along the points.
  double radius_px = 0.0;
};

/// How a person looks at it.
struct ScreenView {
  /// Takes homogeneous points, metres, to (x w, y w, _, w): w > 0 in front of the camera, and
  /// growing with the distance from it.
  Eigen::Matrix4d to_pixels = Eigen::Matrix4d::Identity();
  int width = 0, height = 0;  ///< of the screen; what lies outside is never selected
};

/// One flag a pixel, row by row: 1 where the pixel's centre lies in the region.
std::vector<std::uint8_t> region_mask(const ScreenRegion& region, int width, int height);

/// Triangles whose middle lies in the region; of a brush also those with a corner in it, or that it
/// touches where they are in sight, so that it reaches triangles larger than itself. visible_only:
/// those that no other part of the mesh hides, from either side. Whether something is hidden is
/// known to a pixel: what is smaller than one may be taken for the surface that it lies on.
/// Triangles that reach behind the camera are neither selected nor do they hide any. Fails with
/// kFormat as validate_mesh(), kCancelled.
Result<Selection> select_on_screen(const TriangleMesh& mesh, const ScreenRegion& region,
                                   const ScreenView& view, bool visible_only,
                                   const RunContext& context);

/// Points in the region. visible_only: those that no nearer points hide, each taken as large as a
/// few pixels.
Result<Selection> select_on_screen(std::span<const Vec3f> points, const ScreenRegion& region,
                                   const ScreenView& view, bool visible_only,
                                   const RunContext& context);

}  // namespace turnscan
