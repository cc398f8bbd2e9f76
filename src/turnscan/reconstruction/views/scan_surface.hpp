#pragma once
// A range scan as points and triangles between them, resampled to a depth image.

#include <turnscan/core/frame.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::views {

/// A surface seen by a scanner, in the sensor frame.
struct ScanSurface {
  std::vector<Vec3f> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< between neighbours, of either
                                                        ///< orientation
  std::vector<Rgb> colors;                              ///< per point, or empty
  Viewpoint viewpoint;
};

/// Triangles between each point and its neighbours as seen from the viewpoint, with sides up to
/// longest_m, for unordered points. They overlap.
std::vector<std::array<std::uint32_t, 3>> triangle_fans(const ScanSurface& surface,
                                                        double longest_m);

/// Renders the surface from its viewpoint, with pixels of pixel_m at its middle; the nearest
/// surface is kept, as the mean of the triangles within edge_step_m of each other. Triangles deeper
/// than edge_step_m are skipped; points without triangles are dots. Empty if that needs more than
/// 4096 pixels per side.
DepthView view_of_surface(const ScanSurface& surface, const Pose& T_table_sensor, double pixel_m,
                          double edge_step_m);

}  // namespace turnscan::views
