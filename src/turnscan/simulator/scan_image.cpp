#include <algorithm>
#include <cmath>
#include <turnscan/simulator/color/color_image.hpp>
#include <turnscan/simulator/scan_image.hpp>

namespace turnscan::sampling {

namespace {

constexpr Rgb kPlatterColor{140, 142, 146};
constexpr Rgb kEmptyColor{28, 30, 34};

Rgb shaded(const Vec3f& color, float light) {
  const Vec3f c = (light * color).cwiseMin(255.0f).cwiseMax(0.0f) + Vec3f::Constant(0.5f);
  return {std::uint8_t(c.x()), std::uint8_t(c.y()), std::uint8_t(c.z())};
}

Rgb lit(const SampleHit& hit, const Vec3f& color) {
  return shaded(color, 0.35f + 0.65f * static_cast<float>(std::cos(hit.incidence_rad)));
}

}  // namespace

DepthImage depth_image(const SampleGrid& grid, std::span<const float> z, double unit_m) {
  DepthImage depth(grid.width, grid.height, kNoReturn);
  const double scale = 1.0 / unit_m;
  for (int y = grid.rect.top; y < grid.rect.bottom; ++y) {
    const float* from = z.data() + grid.index(grid.rect.left, y);
    std::uint16_t* to = &depth.at(grid.rect.left, y);
    for (int x = 0; x < grid.rect.width(); ++x) {
      const double raw = std::floor(double(from[x]) * scale + 0.5);
      if (raw >= 1.0 && raw < double(kOutsideCrop)) to[x] = static_cast<std::uint16_t>(raw);
    }
  }
  return depth;
}

Albedo albedo_of(const std::vector<std::span<const TriangleMesh>>& meshes) {
  std::vector<std::vector<std::vector<float>>> all;
  for (const auto& body : meshes) {
    auto& objects = all.emplace_back();
    for (const TriangleMesh& mesh : body) objects.push_back(triangle_albedos(mesh));
  }
  TriangleMesh platter;
  platter.vertices.resize(3);
  platter.colors.assign(3, kPlatterColor);
  platter.triangles = {{0, 1, 2}};
  const float on_platter = triangle_albedos(platter)[0];
  return [all = std::move(all), on_platter](std::uint32_t body, std::uint32_t object,
                                            std::uint32_t triangle) {
    if (object == kPlatter) return on_platter;
    const std::vector<float>& values = all[body][object];
    return values.empty() ? static_cast<float>(kDefaultAlbedo) : values[triangle];
  };
}

Vec3f Paint::color(const Samples& samples, std::size_t i, const SampleHit& hit) const {
  const std::uint32_t object = samples.object(i);
  if (object == kPlatter) return platter_color();
  return surface_color(meshes_[samples.body(i)][object], samples.triangle[i],
                       static_cast<float>(hit.u), static_cast<float>(hit.v));
}

ColorImage color_image(const SampleTracer& tracer, std::span<const Body> bodies,
                       const Pose& T_world_sensor, const SampleGrid& grid, const Paint& paint) {
  ColorImage image(grid.width, grid.height, kEmptyColor);
  for (int y = grid.rect.top; y < grid.rect.bottom; ++y) {
    for (int x = grid.rect.left; x < grid.rect.right; ++x) {
      const std::size_t i = grid.index(x, y);
      if (!grid.hit(i)) continue;
      const SampleHit hit = tracer.hit_of(bodies, T_world_sensor, grid, i, tracer.direction(x, y));
      image.at(x, y) = lit(hit, paint.color(grid, i, hit));
    }
  }
  return image;
}

ColorImage mean_image(std::span<const ColorImage> images) {
  ColorImage mean = images[0];
  const auto n = static_cast<unsigned>(images.size());
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    unsigned r = n / 2, g = n / 2, b = n / 2;
    for (const ColorImage& image : images) {
      r += image.pixels[i].r;
      g += image.pixels[i].g;
      b += image.pixels[i].b;
    }
    mean.pixels[i] = {std::uint8_t(r / n), std::uint8_t(g / n), std::uint8_t(b / n)};
  }
  return mean;
}

PointCloud scan_points(const SampleTracer& tracer, std::span<const Body> bodies,
                       const Pose& T_world_sensor, const SampleGrid& grid, std::span<const float> z,
                       const Paint* paint) {
  PointCloud cloud;
  for (int y = grid.rect.top; y < grid.rect.bottom; ++y) {
    for (int x = grid.rect.left; x < grid.rect.right; ++x) {
      const std::size_t i = grid.index(x, y);
      if (!(z[i] > 0.0f)) continue;
      const Vec3d direction = tracer.direction(x, y);
      cloud.points.emplace_back((double(z[i]) * direction).cast<float>());
      if (paint == nullptr) continue;
      const SampleHit hit = tracer.hit_of(bodies, T_world_sensor, grid, i, direction);
      cloud.colors.push_back(lit(hit, paint->color(grid, i, hit)));
    }
  }
  return cloud;
}

}  // namespace turnscan::sampling
