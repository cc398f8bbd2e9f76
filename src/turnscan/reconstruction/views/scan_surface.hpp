#pragma once
// A range scan as points and the triangles between them, resampled to a depth image.

#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::views {

/// What a scanner saw, in the sensor frame.
struct ScanSurface {
  std::vector<Vec3f> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< between neighbours, any way round
  std::vector<Rgb> colors;                              ///< per point, or empty
  Viewpoint viewpoint;
};

/// Triangles between each point and its neighbours, as the viewpoint sees them, with sides up to
/// longest_m: for points in no order. They overlap.
std::vector<std::array<std::uint32_t, 3>> triangle_fans(const ScanSurface& surface,
                                                        double longest_m);

/// Draws it as the viewpoint sees it, with pixels of pixel_m at its middle; the nearest surface
/// stays, as the mean of the triangles that are within edge_step_m of each other. Triangles that
/// are deeper than edge_step_m are left out; points without triangles are dots. Empty where that
/// takes more than 4096 pixels a side.
DepthView view_of_surface(const ScanSurface& surface, const Pose& T_table_sensor, double pixel_m,
                          double edge_step_m);

}  // namespace turnscan::views
