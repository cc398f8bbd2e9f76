#pragma once
// A mesh as a depth camera would see it.

#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::views {

/// The nearest surface, kSide^2 samples a pixel, of which the middle one lies at the pixel's
/// centre.
class ViewDrawing {
 public:
  static constexpr int kSide = 3;

  /// view must outlive it; its pixels do not matter. Only triangles that face it are drawn.
  ViewDrawing(const DepthView& view, const TriangleMesh& mesh);

  /// What a pixel receives: light that falls with distance squared and cosine of incidence, from a
  /// lamp beside the camera, and that light times depth.
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
