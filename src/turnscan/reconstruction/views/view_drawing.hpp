#pragma once
// Renders a mesh as a depth camera would see it.

#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::views {

/// The nearest surface, with kSide^2 samples per pixel, the middle one at the pixel's centre.
class ViewDrawing {
 public:
  static constexpr int kSide = 3;

  /// view must outlive it; its pixels are not used. Only triangles that face it are drawn.
  ViewDrawing(const DepthView& view, const TriangleMesh& mesh);

  /// Light that a pixel receives from a lamp beside the camera, decreasing with the squared
  /// distance and the cosine of incidence, and that light times depth.
  struct Received {
    float light = 0.0f, depth = 0.0f;
    float mean() const { return depth / light; }
  };
  Received received(int x, int y) const;

 private:
  void draw(const Vec3f& a, const Vec3f& b, const Vec3f& c, float cosine);

  const DepthView* view_;
  int width_, height_;
  std::vector<float> depth_, light_;
};

}  // namespace turnscan::views
