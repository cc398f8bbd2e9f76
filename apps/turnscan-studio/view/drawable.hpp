#pragma once
// Meshes, clouds and lines made ready for the graphics library, on any thread.

#include <cstdint>
#include <memory>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::studio {

/// Geometry as it is drawn; see drawable_parts.hpp.
struct Drawable;
using DrawablePtr = std::shared_ptr<const Drawable>;

/// Pairs of points, metres.
struct Segments {
  std::vector<Vec3f> points;

  void add(const Vec3d& a, const Vec3d& b) {
    points.push_back(a.cast<float>());
    points.push_back(b.cast<float>());
  }
};

enum class Shading {
  kSmooth,  ///< normals of the mesh, or made from it
  kFlat     ///< every face with a normal of its own
};

enum class Texels {
  kBlended,  ///< a picture of something
  kSquares   ///< each texel one colour: what it stands for must not be mixed
};

/// A mesh without triangles gives something that draws nothing. A texture that fits the mesh
/// (has_texture()) is drawn, unless the shading is flat; the picture is shared, not copied.
DrawablePtr make_drawable(const TriangleMesh& mesh, Shading shading = Shading::kSmooth,
                          Texels texels = Texels::kBlended);
/// spacing_m: how far its points lie apart; they are drawn so large that they touch. 0: not known,
/// all are drawn in the view's point size.
DrawablePtr make_drawable(const PointCloud& cloud, double spacing_m = 0.0);
DrawablePtr make_drawable(const Segments& segments);

const Box& box_of(const Drawable& drawable);

}  // namespace turnscan::studio
