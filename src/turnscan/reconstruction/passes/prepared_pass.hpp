#pragma once
// A pass made ready to be compared with others.

#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/passes/free_space.hpp>
#include <turnscan/reconstruction/passes/samples.hpp>

namespace turnscan::passes {

/// A surface at one density, and how to find its points.
struct SurfaceLevel {
  SurfaceLevel(const PassSurface& surface, std::size_t count, int side, double reach_share);

  Samples samples;
  double reach_m;  ///< up to which nearest() finds points
  NearestGrid nearest;
  /// Of each channel (row) by the place, along the surface; empty without colours.
  std::vector<Eigen::Matrix3f> color_gradients;
};

/// From the nearest neighbours of each point; 0 where too few have a colour.
std::vector<Eigen::Matrix3f> color_gradients(std::span<const Vec3f> points,
                                             std::span<const Vec3f> normals,
                                             std::span<const Vec3f> colors);

struct PreparedPass {
  /// surface must outlive it.
  explicit PreparedPass(const PassSurface& surface);

  bool colored() const { return !surface->colors.empty(); }

  const PassSurface* surface;
  double extent_m;  ///< diagonal of the box around it
  double area_m2;
  SurfaceLevel votes, coarse, medium;
  FreeSpace free;
  KdTree tree;                                   ///< of all points
  std::vector<Eigen::Matrix3f> color_gradients;  ///< of all points, as SurfaceLevel's
  float beside_m;  ///< a point of the surface has one of them this near
};

}  // namespace turnscan::passes
