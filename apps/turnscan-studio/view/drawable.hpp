#pragma once
// Converts meshes, clouds and lines for the graphics library, on any thread.

#include <cstdint>
#include <memory>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::studio {

/// Geometry ready to be drawn; see drawable_parts.hpp.
struct Drawable;
using DrawablePtr = std::shared_ptr<const Drawable>;

/// Line segments: pairs of points, metres.
struct Segments {
  std::vector<Vec3f> points;

  void add(const Vec3d& a, const Vec3d& b) {
    points.push_back(a.cast<float>());
    points.push_back(b.cast<float>());
  }
};

enum class Shading {
  kSmooth,  ///< normals of the mesh, or computed from it
  kFlat     ///< one normal per face
};

enum class Texels {
  kBlended,  ///< interpolated, for images
  kSquares   ///< each texel has a single colour: values must not be mixed
};

/// A mesh without triangles gives an empty drawable. A texture that matches the mesh
/// (has_texture()) is drawn, unless the shading is flat; the image is shared, not copied.
DrawablePtr make_drawable(const TriangleMesh& mesh, Shading shading = Shading::kSmooth,
                          Texels texels = Texels::kBlended);
/// moving: what is drawn instead while it moves; empty: nothing else.
DrawablePtr make_drawable(const TriangleMesh& mesh, const TriangleMesh& moving);
/// spacing_m: distance between its points, which are drawn so large that they touch. 0: not known,
/// all are drawn in the view's point size.
DrawablePtr make_drawable(const PointCloud& cloud, double spacing_m = 0.0);
DrawablePtr make_drawable(const Segments& segments);

const Box& box_of(const Drawable& drawable);

}  // namespace turnscan::studio
