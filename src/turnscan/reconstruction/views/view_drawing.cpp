#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/views/view_drawing.hpp>

namespace turnscan::views {

ViewDrawing::ViewDrawing(const DepthView& view, const TriangleMesh& mesh)
    : view_(&view), width_(view.width * kSide), height_(view.height * kSide) {
  depth_.assign(std::size_t(width_) * std::size_t(height_), 0.0f);
  light_.assign(depth_.size(), 0.0f);
  std::vector<Vec3f> place(mesh.vertices.size()), image(mesh.vertices.size());
  for (std::size_t v = 0; v < place.size(); ++v) {
    place[v] = view.rotation * mesh.vertices[v] + view.translation;
    const Eigen::Vector2f at = view.project(place[v]);
    // In sample coordinates; in perspective 1 / z is linear in the image.
    image[v] = {(at.x() + 0.5f) * kSide - 0.5f, (at.y() + 0.5f) * kSide - 0.5f,
                view.parallel ? place[v].z() : 1.0f / place[v].z()};
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f normal = (place[b] - place[a]).cross(place[c] - place[a]);
    const Vec3f ray = view.parallel ? Vec3f::UnitZ() : place[a];
    const float facing = -normal.dot(ray);
    const float nearest = std::min({place[a].z(), place[b].z(), place[c].z()});
    if (facing > 0.0f && nearest > 1e-3f)
      draw(image[a], image[b], image[c], facing / (normal.norm() * ray.norm()));
  }
}

void ViewDrawing::draw(const Vec3f& a, const Vec3f& b, const Vec3f& c, float cosine) {
  const auto within = [](float at, int size) { return int(std::clamp(at, -1.0f, float(size))); };
  const Eigen::Vector2f ab = (b - a).head<2>(), ac = (c - a).head<2>();
  const float area = ab.x() * ac.y() - ab.y() * ac.x();
  if (!(std::abs(area) > 1e-9f)) return;
  const int x0 = std::max(0, within(std::ceil(std::min({a.x(), b.x(), c.x()})), width_));
  const int x1 = std::min(width_ - 1, within(std::floor(std::max({a.x(), b.x(), c.x()})), width_));
  const int y0 = std::max(0, within(std::ceil(std::min({a.y(), b.y(), c.y()})), height_));
  const int y1 =
      std::min(height_ - 1, within(std::floor(std::max({a.y(), b.y(), c.y()})), height_));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const float u = float(x) - a.x(), v = float(y) - a.y();
      const float s = (u * ac.y() - v * ac.x()) / area, t = (ab.x() * v - ab.y() * u) / area;
      if (s < 0.0f || t < 0.0f || s + t > 1.0f) continue;
      const float w = a.z() + s * (b.z() - a.z()) + t * (c.z() - a.z());
      const float z = view_->parallel ? w : 1.0f / w;
      const std::size_t at = std::size_t(y) * std::size_t(width_) + std::size_t(x);
      if (depth_[at] > 0.0f && depth_[at] <= z) continue;
      depth_[at] = z;
      light_[at] = view_->parallel ? cosine : cosine / (z * z);
    }
  }
}

ViewDrawing::Received ViewDrawing::received(int x, int y) const {
  Received out;
  for (int j = y * kSide; j < (y + 1) * kSide; ++j) {
    for (int i = x * kSide; i < (x + 1) * kSide; ++i) {
      const std::size_t at = std::size_t(j) * std::size_t(width_) + std::size_t(i);
      out.light += light_[at];
      out.depth += light_[at] * depth_[at];
    }
  }
  return out;
}

}  // namespace turnscan::views
