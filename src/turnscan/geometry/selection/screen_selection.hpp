#pragma once
// Selects the part of a mesh or cloud within a region of the screen.

#include <span>
#include <turnscan/core/eigen.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/selection/selection.hpp>
#include <vector>

namespace turnscan {

/// A region of the screen, in pixels: x to the right, y down.
struct ScreenRegion {
  std::vector<Eigen::Vector2d> points;
  /// 0: the interior of the closed outline through the points, by the even-odd rule; else the
  /// stroke of a brush of this radius along the points.
  double radius_px = 0.0;
};

/// Projection of the model to the screen.
struct ScreenView {
  /// Maps homogeneous points, metres, to (x w, y w, _, w): w > 0 in front of the camera, and
  /// increasing with the distance from it.
  Eigen::Matrix4d to_pixels = Eigen::Matrix4d::Identity();
  int width = 0, height = 0;  ///< of the screen; nothing outside is ever selected
};

/// One flag per pixel, row by row: 1 if the pixel's centre is in the region.
std::vector<std::uint8_t> region_mask(const ScreenRegion& region, int width, int height);

/// Triangles whose centroid is in the region; for a brush also those with a corner in it, or that
/// it touches where they are visible, so that it selects triangles larger than itself.
/// visible_only: only those that no other part of the mesh occludes; triangles are two-sided.
/// Occlusion is resolved per pixel: triangles smaller than a pixel may be confused with the surface
/// that they are on. Triangles that extend behind the camera are neither selected nor occlude
/// others. Fails with kFormat as validate_mesh(), kCancelled.
Result<Selection> select_on_screen(const TriangleMesh& mesh, const ScreenRegion& region,
                                   const ScreenView& view, bool visible_only,
                                   const RunContext& context);

/// Points in the region. visible_only: only those that no nearer points occlude, each drawn with a
/// size of a few pixels.
Result<Selection> select_on_screen(std::span<const Vec3f> points, const ScreenRegion& region,
                                   const ScreenView& view, bool visible_only,
                                   const RunContext& context);

}  // namespace turnscan
