#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/rendering/picture.hpp>
#include <turnscan/simulator/rendering/picture_camera.hpp>
#include <turnscan/simulator/rendering/picture_surface.hpp>
#include <turnscan/simulator/scene/scene.hpp>

namespace turnscan {

namespace {

constexpr int kSamplesPerSide = 2;
constexpr int kSamples = kSamplesPerSide * kSamplesPerSide;
constexpr std::size_t kKeyRays = 2;    // of each sample
constexpr float kLightRadius = 0.05f;  // of the key light's disc at distance 1: soft shadows
constexpr float kGroundBounce = 0.6f;  // light that comes from below, as part of the sky's
const Vec3f kKeyColor(0.80f, 0.77f, 0.72f);
const Vec3f kFillColor(0.20f, 0.22f, 0.25f);
const Vec3f kSkyColor(0.44f, 0.46f, 0.48f);
const Vec3f kBackSide(0.50f, 0.05f, 0.04f);  // the inside of a mesh: shows holes and wrong winding

std::vector<Vec3f> used_vertices(std::span<const TriangleMesh> meshes) {
  std::vector<Vec3f> points;
  for (const TriangleMesh& mesh : meshes) {
    std::vector<bool> used(mesh.vertices.size(), false);
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t) used[v] = true;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v]) points.push_back(mesh.vertices[v]);
  }
  return points;
}

/// Two vectors that are at right angles to n and to each other.
std::pair<Vec3f, Vec3f> tangents(const Vec3f& n) {
  const Vec3f helper = std::abs(n.y()) < 0.9f ? Vec3f::UnitY() : Vec3f::UnitX();
  const Vec3f a = n.cross(helper).normalized();
  return {a, n.cross(a)};
}

/// Uniform on the unit disc.
Eigen::Vector2f disc_point(double u, double v) {
  const double r = std::sqrt(u), angle = kTurn * v;
  return {static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle))};
}

/// A place that light is to be found for.
struct Spot {
  std::size_t pixel = 0;
  Vec3f position;  ///< a little off the surface
  Vec3f normal;
  Vec3f albedo;
  bool ground = false;
  std::uint64_t key = 0;   ///< of the pixel's random numbers
  std::size_t sample = 0;  ///< which of the pixel's samples it is
};

/// Point k of n of a spot on the unit disc. The points of all samples of a pixel together are
/// evenly spread: strata for the radius, golden ratio steps for the angle.
Eigen::Vector2f spread_point(const Spot& spot, std::size_t k, std::size_t n, std::uint64_t salt) {
  const std::size_t index = k * kSamples + spot.sample;
  const std::uint64_t key = mix64(spot.key ^ salt);
  const double u = (double(index) + uniform01(mix64(key + 1 + index))) / double(n * kSamples);
  const double v = std::fmod(uniform01(key) + 0.6180339887498949 * double(index), 1.0);
  return disc_point(u, v);
}

struct Light {
  float key = 0.0f;  ///< share of the key light that arrives
  float sky = 0.0f;  ///< share of the sky's light that arrives
};

class Painter {
 public:
  Painter(const Scene& scene, const PictureOptions& options,
          const std::vector<rendering::PictureSurface>& surfaces)
      : scene_(scene), options_(options), surfaces_(surfaces) {
    const Box& box = scene.object_box();
    scale_ = static_cast<float>(box.size().norm());
    ground_y_ = static_cast<float>(box.min.y());
  }

  /// One row of the view's pixels, from the left.
  void paint_row(const rendering::PictureCamera& camera, const Vec3f& to_light, int view, int row,
                 std::span<Rgb> out) const {
    std::vector<Ray> rays = rays_of_row(camera, row);
    std::vector<RayHit> hits(rays.size());
    scene_.intersect(rays, hits, RayOrder::kCoherent);
    std::vector<Vec3f> sums(out.size(), Vec3f::Zero());
    std::vector<Spot> spots;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const std::size_t pixel = i / kSamples;
      if (auto spot = spot_of(rays[i], hits[i])) {
        spot->pixel = pixel;
        spot->key = hash_key(0x70696374, std::uint64_t(view), std::uint64_t(row), pixel);
        spot->sample = i % kSamples;
        spots.push_back(*spot);
      } else {
        sums[pixel] += rendering::linear_of(options_.background);
      }
    }
    const std::vector<Light> lights = light_of(spots, to_light);
    for (std::size_t i = 0; i < spots.size(); ++i)
      sums[spots[i].pixel] += shade(spots[i], lights[i], to_light);
    for (std::size_t x = 0; x < out.size(); ++x)
      out[x] = rendering::rgb_of(sums[x] / float(kSamples));
  }

 private:
  std::vector<Ray> rays_of_row(const rendering::PictureCamera& camera, int row) const {
    std::vector<Ray> rays;
    rays.reserve(std::size_t(options_.width) * kSamples);
    for (int x = 0; x < options_.width; ++x) {
      for (int s = 0; s < kSamples; ++s) {
        const int column = s % kSamplesPerSide, line = s / kSamplesPerSide;
        const double u = x + (column + 0.5) / kSamplesPerSide;
        const double v = row + (line + 0.5) / kSamplesPerSide;
        Ray ray;
        ray.origin = camera.eye.cast<float>();
        ray.direction =
            camera.direction(2.0 * u / options_.width - 1.0, 1.0 - 2.0 * v / options_.height)
                .cast<float>();
        rays.push_back(ray);
      }
    }
    return rays;
  }

  std::optional<Spot> spot_of(const Ray& ray, const RayHit& hit) const {
    Spot spot;
    if (hit.valid()) {
      const bool back = hit.normal.dot(ray.direction) > 0.0f;
      const rendering::PictureSurface& surface = surfaces_[hit.object];
      const Vec3f face = back ? Vec3f(-hit.normal) : hit.normal;
      spot.normal = back ? Vec3f(-surface.normal(hit)) : surface.normal(hit);
      const Vec3f plain = rendering::linear_of(options_.surface);
      spot.albedo = back ? kBackSide : options_.use_colors ? surface.albedo(hit, plain) : plain;
      spot.position = ray.origin + hit.t * ray.direction + 2e-4f * scale_ * face;
      return spot;
    }
    if (!options_.ground || !(ray.direction.y() < 0.0f) || ray.origin.y() <= ground_y_)
      return std::nullopt;
    const float t = (ground_y_ - ray.origin.y()) / ray.direction.y();
    spot.position = ray.origin + t * ray.direction;
    spot.position.y() = ground_y_ - 1e-5f * scale_;
    if ((spot.position - scene_.object_box().center().cast<float>()).norm() > 4.0f * scale_)
      return std::nullopt;
    spot.normal = Vec3f::UnitY();
    spot.albedo = rendering::linear_of(options_.background);
    spot.ground = true;
    return spot;
  }

  std::vector<Light> light_of(const std::vector<Spot>& spots, const Vec3f& to_light) const {
    std::vector<Light> lights(spots.size());
    std::vector<Ray> rays(spots.size() * kKeyRays);
    std::vector<std::uint8_t> blocked(rays.size());
    const auto [a, b] = tangents(to_light);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Spot& spot = spots[i / kKeyRays];
      const Eigen::Vector2f d = kLightRadius * spread_point(spot, i % kKeyRays, kKeyRays, 1);
      rays[i] = {spot.position, to_light + d.x() * a + d.y() * b};
    }
    scene_.occluded(rays, blocked, RayOrder::kCoherent);
    for (std::size_t i = 0; i < rays.size(); ++i)
      lights[i / kKeyRays].key += blocked[i] ? 0.0f : 1.0f / kKeyRays;
    add_sky(spots, lights);
    return lights;
  }

  /// Rays spread by the cosine, stratified; what goes down unhindered meets the ground.
  void add_sky(const std::vector<Spot>& spots, std::vector<Light>& lights) const {
    const auto all = static_cast<std::size_t>(options_.ambient_samples);
    std::vector<Ray> rays(all);
    std::vector<std::uint8_t> blocked(all);
    for (std::size_t i = 0; i < spots.size(); ++i) {
      // The floor is most of the picture and has little to show.
      const std::size_t n = spots[i].ground ? (all + 1) / 2 : all;
      const auto [a, b] = tangents(spots[i].normal);
      float sum = 0.0f;
      for (std::size_t k = 0; k < n; ++k) {
        const Eigen::Vector2f d = spread_point(spots[i], k, n, 2);
        const float up = std::sqrt(std::max(0.0f, 1.0f - d.squaredNorm()));
        rays[k] = {spots[i].position, d.x() * a + d.y() * b + up * spots[i].normal};
      }
      scene_.occluded(std::span(rays).first(n), std::span(blocked).first(n), RayOrder::kIncoherent);
      for (std::size_t k = 0; k < n; ++k)
        if (!blocked[k]) sum += rays[k].direction.y() > 0.0f ? 1.0f : kGroundBounce;
      lights[i].sky = n > 0 ? sum / float(n) : 1.0f;
    }
  }

  Vec3f shade(const Spot& spot, const Light& light, const Vec3f& to_light) const {
    if (spot.ground) {
      // Only the shadow shows, so that the floor and the background are one.
      const float lit = 0.45f * light.key + 0.55f * light.sky;
      return spot.albedo * (0.35f + 0.65f * lit);
    }
    const float key = std::max(0.0f, spot.normal.dot(to_light)) * light.key;
    const Vec3f from_fill = Vec3f(-to_light.x(), 0.3f, -to_light.z()).normalized();
    const float fill = 0.5f + 0.5f * spot.normal.dot(from_fill);
    return spot.albedo.cwiseProduct(key * kKeyColor + light.sky * (kSkyColor + fill * kFillColor));
  }

  const Scene& scene_;
  const PictureOptions& options_;
  const std::vector<rendering::PictureSurface>& surfaces_;
  float scale_ = 1.0f;
  float ground_y_ = 0.0f;
};

struct ViewSetup {
  rendering::PictureCamera camera;
  Vec3f to_light;
};

std::vector<ViewSetup> views_around(const std::vector<Vec3f>& points, const PictureOptions& o) {
  std::vector<ViewSetup> views;
  for (int i = 0; i < o.views; ++i) {
    const double azimuth = o.azimuth_rad + kTurn * i / o.views;
    const double light = azimuth - 0.75, height = 0.7;
    views.push_back({rendering::camera_around(points, azimuth, o.elevation_rad, o.field_of_view_rad,
                                              double(o.width) / o.height, o.zoom),
                     Vec3d(std::sin(light) * std::cos(height), std::sin(height),
                           std::cos(light) * std::cos(height))
                         .cast<float>()});
  }
  return views;
}

}  // namespace

OptionTable describe(PictureOptions& o) {
  constexpr double kPi = std::numbers::pi;
  OptionTable table;
  table.number("picture-width", o.width, {1, 16384}, "Width of one view of the picture in pixels.")
      .number("picture-height", o.height, {1, 16384}, "Height of the picture in pixels.")
      .number("picture-azimuth", o.azimuth_rad, Quantity::kAngle, {-2 * kPi, 2 * kPi},
              "Where the picture is seen from: 0 is the front (+Z), 90 deg the +X side.")
      .number("picture-elevation", o.elevation_rad, Quantity::kAngle, {-kPi / 2, kPi / 2},
              "Height above the horizontal that the picture is seen from.")
      .number("picture-views", o.views, {1, 64}, "Views side by side, spread over the full circle.")
      .number("picture-field-of-view", o.field_of_view_rad, Quantity::kAngle, {0.01, 2.5},
              "Vertical field of view of the picture.")
      .number("picture-zoom", o.zoom, Quantity::kNone, {0.05, 100.0},
              "Above 1 the picture comes nearer than all of the object.")
      .flag("picture-ground", o.ground, "A floor in the picture that catches shadows.")
      .flag("picture-smooth", o.smooth, "Interpolated normals in the picture.")
      .flag("picture-colours", o.use_colors, "Textures and vertex colours in the picture.")
      .number("picture-samples", o.ambient_samples, {0, 1024},
              "Rays for each of a pixel's four samples that look for the sky.");
  return table;
}

Result<ColorImage> render_picture(std::span<const TriangleMesh> meshes,
                                  const PictureOptions& options, const RunContext& context) {
  PictureOptions copy = options;
  TURNSCAN_TRY(describe(copy).check());
  TURNSCAN_ASSIGN(const Scene scene, Scene::create(meshes));
  ColorImage image(options.width * options.views, options.height, options.background);
  if (scene.object_box().empty()) return image;
  std::vector<rendering::PictureSurface> surfaces;
  surfaces.reserve(meshes.size());
  for (const TriangleMesh& mesh : meshes) surfaces.emplace_back(mesh, options.smooth);
  const std::vector<ViewSetup> views = views_around(used_vertices(meshes), options);
  const Painter painter(scene, options, surfaces);
  const auto rows = static_cast<std::size_t>(options.height) * views.size();
  context.begin_phase("render picture", rows);
  parallel_for(rows, 1, [&](std::size_t i) {
    if (context.cancelled()) return;
    const auto view = static_cast<int>(i / std::size_t(options.height));
    const auto row = static_cast<int>(i % std::size_t(options.height));
    const std::size_t first = std::size_t(row) * image.width + std::size_t(view) * options.width;
    painter.paint_row(views[view].camera, views[view].to_light, view, row,
                      std::span(image.pixels).subspan(first, options.width));
    context.advance();
  });
  TURNSCAN_TRY(context.check());
  return image;
}

ColorImage side_by_side(std::span<const ColorImage> images, Rgb fill) {
  int width = 0, height = 0;
  for (const ColorImage& image : images) {
    width += image.width;
    height = std::max(height, image.height);
  }
  ColorImage out(width, height, fill);
  int left = 0;
  for (const ColorImage& image : images) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) out.at(left + x, y) = image.at(x, y);
    left += image.width;
  }
  return out;
}

}  // namespace turnscan
