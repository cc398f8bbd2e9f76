#pragma once
// A pass prepared for comparisons with others.

#include <turnscan/geometry/search/knn.hpp>
#include <turnscan/reconstruction/passes/free_space.hpp>
#include <turnscan/reconstruction/passes/samples.hpp>

namespace turnscan::passes {

/// A surface at one density, with a search structure for its points.
struct SurfaceLevel {
  SurfaceLevel(const PassSurface& surface, std::size_t count, int side, double reach_share);

  Samples samples;
  double reach_m;  ///< maximum distance of points found by nearest()
  NearestGrid nearest;
  /// Gradients of each channel (row) by position, along the surface; empty without colours.
  std::vector<Eigen::Matrix3f> color_gradients;
};

/// Gradients from the nearest neighbours of each point; 0 if too few of them have a colour.
std::vector<Eigen::Matrix3f> color_gradients(std::span<const Vec3f> points,
                                             std::span<const Vec3f> normals,
                                             std::span<const Vec3f> colors);

struct PreparedPass {
  /// surface must outlive it.
  explicit PreparedPass(const PassSurface& surface);

  bool colored() const { return !surface->colors.empty(); }

  const PassSurface* surface;
  double extent_m;  ///< diagonal of its bounding box
  double area_m2;
  SurfaceLevel votes, coarse, medium;
  Vec3d middle;             ///< of the coarse points
  Eigen::Matrix3d scatter;  ///< their mean squares about it
  FreeSpace free;
  KdTree tree;                                   ///< of all points
  std::vector<Eigen::Matrix3f> color_gradients;  ///< of all points, as SurfaceLevel's
  float beside_m;  ///< distance within which a point of the surface has another one
};

}  // namespace turnscan::passes
