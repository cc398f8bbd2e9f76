#include <algorithm>
#include <cmath>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/simulator/rendering/picture_surface.hpp>

namespace turnscan::rendering {

namespace {

constexpr float kCosCrease = 0.766f;  // 40 deg
/// Triangles about a vertex, beyond which it has no normal of its own: each pixel beside it adds
/// them up, and caps of cylinders have hundreds.
constexpr std::uint32_t kMaxAround = 10000;

/// Length is twice the area.
Vec3f area_normal(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& t = mesh.triangles[triangle];
  const Vec3f& a = mesh.vertices[t[0]];
  return (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
}

}  // namespace

PictureSurface::PictureSurface(const TriangleMesh& mesh, bool smooth) : mesh_(mesh) {
  if (!smooth) return;
  first_.assign(mesh.vertices.size() + 1, 0);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) ++first_[v + 1];
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) first_[v + 1] += first_[v];
  around_.resize(mesh.triangles.size() * 3);
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::uint32_t v : mesh.triangles[i]) around_[next[v]++] = i;
}

Vec3f PictureSurface::corner_normal(std::uint32_t vertex, const Vec3f& face_normal) const {
  if (first_[vertex + 1] - first_[vertex] > kMaxAround) return face_normal;
  Vec3f sum = Vec3f::Zero();
  for (std::uint32_t i = first_[vertex]; i < first_[vertex + 1]; ++i) {
    const Vec3f n = area_normal(mesh_, around_[i]);
    if (n.dot(face_normal) >= kCosCrease * n.norm()) sum += n;
  }
  const float length = sum.norm();
  return length > 0.0f ? Vec3f(sum / length) : face_normal;
}

Vec3f PictureSurface::normal(const RayHit& hit) const {
  if (first_.empty()) return hit.normal;
  const auto& t = mesh_.triangles[hit.triangle];
  const Vec3f n = (1.0f - hit.u - hit.v) * corner_normal(t[0], hit.normal) +
                  hit.u * corner_normal(t[1], hit.normal) + hit.v * corner_normal(t[2], hit.normal);
  const float length = n.norm();
  return length > 0.0f ? Vec3f(n / length) : hit.normal;
}

Vec3f PictureSurface::albedo(const RayHit& hit, const Vec3f& otherwise) const {
  if (has_texture(mesh_)) {
    const Vec3f c = texture_at(mesh_, hit.triangle, hit.u, hit.v) / 255.0f;
    return c.array().pow(2.2f).matrix();
  }
  if (mesh_.colors.size() != mesh_.vertices.size()) return otherwise;
  const auto& t = mesh_.triangles[hit.triangle];
  return (1.0f - hit.u - hit.v) * linear_of(mesh_.colors[t[0]]) +
         hit.u * linear_of(mesh_.colors[t[1]]) + hit.v * linear_of(mesh_.colors[t[2]]);
}

Vec3f linear_of(Rgb color) {
  const auto channel = [](std::uint8_t c) { return std::pow(float(c) / 255.0f, 2.2f); };
  return {channel(color.r), channel(color.g), channel(color.b)};
}

Rgb rgb_of(const Vec3f& linear) {
  const auto channel = [](float c) {
    const float value = std::pow(std::clamp(c, 0.0f, 1.0f), 1.0f / 2.2f);
    return static_cast<std::uint8_t>(std::lround(255.0f * value));
  };
  return {channel(linear.x()), channel(linear.y()), channel(linear.z())};
}

}  // namespace turnscan::rendering
