#include "bench/texture/painted.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/texture/atlas.hpp>

namespace turnscan::bench {

namespace {

float at_corner(int x, int y, int z, std::uint64_t salt) {
  return float(uniform01(hash_key(salt, std::uint64_t(std::int64_t(x)),
                                  std::uint64_t(std::int64_t(y)), std::uint64_t(std::int64_t(z)))));
}

/// Smooth noise of waves of that length, 0 to 1.
float grain(const Vec3f& p, float length_m, std::uint64_t salt) {
  const Vec3f q = p / length_m;
  const int x = int(std::floor(q.x())), y = int(std::floor(q.y())), z = int(std::floor(q.z()));
  Vec3f f = q - Vec3f(float(x), float(y), float(z));
  f = f.cwiseProduct(f).cwiseProduct(Vec3f::Constant(3.0f) - 2.0f * f);
  float sum = 0.0f;
  for (int i = 0; i < 8; ++i) {
    const int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
    sum += (dx ? f.x() : 1 - f.x()) * (dy ? f.y() : 1 - f.y()) * (dz ? f.z() : 1 - f.z()) *
           at_corner(x + dx, y + dy, z + dz, salt);
  }
  return sum;
}

}  // namespace

Vec3f paint_at(const Vec3f& p) {
  const float wide = grain(p, 0.03f, 1), middle = grain(p, 0.008f, 2), fine = grain(p, 0.003f, 3);
  Vec3f color =
      Vec3f(200.0f, 170.0f, 130.0f) + 60.0f * Vec3f(wide - 0.5f, 0.5f - wide, middle - 0.5f);
  const float dots = grain(p, 0.012f, 4);
  if (dots > 0.66f) color = Vec3f(50.0f, 60.0f, 120.0f);
  if (std::abs(std::fmod(p.y() + 1.0f, 0.03f) - 0.015f) < 0.0018f)
    color = Vec3f(170.0f, 40.0f, 35.0f);
  color += 36.0f * Vec3f::Constant(fine - 0.5f) + 24.0f * Vec3f::Constant(middle - 0.5f);
  return color.cwiseMax(5.0f).cwiseMin(235.0f);
}

Result<> paint(TriangleMesh& mesh, int size_px) {
  TURNSCAN_ASSIGN(const texture::Atlas atlas,
                  texture::make_atlas(mesh, size_px, 1e9, RunContext()));
  auto painted = std::make_shared<MeshTexture>();
  painted->image = ColorImage(size_px, size_px);
  painted->corners.resize(atlas.corners.size());
  // Each triangle with a margin, so that nothing else shows at the seams; its own texels last.
  for (const bool margin : {true, false}) {
    for (std::size_t t = 0; t < atlas.corners.size(); ++t) {
      const auto& c = atlas.corners[t];
      const Eigen::Vector2f ab = c[1] - c[0], ac = c[2] - c[0];
      const float area = ab.x() * ac.y() - ac.x() * ab.y();
      const auto& v = mesh.triangles[t];
      const Vec3f a = mesh.vertices[v[0]], b = mesh.vertices[v[1]] - a, d = mesh.vertices[v[2]] - a;
      const auto put = [&](int x, int y) {
        if (area == 0.0f || x < 0 || y < 0 || x >= size_px || y >= size_px) return;
        const float px = float(x) + 0.5f - c[0].x(), py = float(y) + 0.5f - c[0].y();
        const Vec3f p =
            a + ((px * ac.y() - py * ac.x()) / area) * b + ((py * ab.x() - px * ab.y()) / area) * d;
        const Vec3f color = paint_at(p);
        painted->image.at(x, y) = {std::uint8_t(color.x()), std::uint8_t(color.y()),
                                   std::uint8_t(color.z())};
      };
      if (!margin) {
        texture::for_each_texel(c, put);
        continue;
      }
      const auto [x0, x1] = std::minmax({c[0].x(), c[1].x(), c[2].x()});
      const auto [y0, y1] = std::minmax({c[0].y(), c[1].y(), c[2].y()});
      if ((x1 - x0) * (y1 - y0) > 4096.0f) {  // only about its corners and along its edges
        for (std::size_t k = 0; k < 3; ++k)
          for (float s = 0.0f; s <= 1.0f; s += 0.002f) {
            const Eigen::Vector2f e = (1 - s) * c[k] + s * c[(k + 1) % 3];
            for (int dy = -2; dy <= 2; ++dy)
              for (int dx = -2; dx <= 2; ++dx) put(int(e.x()) + dx, int(e.y()) + dy);
          }
        continue;
      }
      for (int y = int(y0) - 2; y <= int(y1) + 2; ++y)
        for (int x = int(x0) - 2; x <= int(x1) + 2; ++x) put(x, y);
    }
  }
  for (std::size_t t = 0; t < atlas.corners.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      painted->corners[t][k] = atlas.corners[t][k] / float(size_px);
  mesh.texture = std::move(painted);
  return {};
}

}  // namespace turnscan::bench
