#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/rendering/painter.hpp>

namespace turnscan::rendering {

namespace {

constexpr int kSamplesPerSide = 2;
constexpr int kSamples = kSamplesPerSide * kSamplesPerSide;
constexpr std::size_t kKeyRays = 2;    // per sample
constexpr std::size_t kPacket = 16;    // rays that the scene traces together
constexpr float kLightRadius = 0.05f;  // of the key light's disc at distance 1: soft shadows
constexpr float kGroundBounce = 0.6f;  // light from below, relative to the sky's
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

/// Two vectors perpendicular to n and to each other.
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

/// A point to be lit.
struct Spot {
  std::size_t pixel = 0;
  Vec3f position;  ///< slightly off the surface
  Vec3f normal;
  Vec3f albedo;
  bool ground = false;
  std::uint64_t key = 0;   ///< of the pixel's random numbers
  std::size_t sample = 0;  ///< index among the pixel's samples
};

/// Point k of n of a spot on the unit disc. The points of all samples of a pixel together are
/// evenly distributed: strata for the radius, golden ratio steps for the angle.
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
  Painter(const Subject& subject, const PictureOptions& options, const RunContext& context)
      : scene_(subject.scene), options_(options), surfaces_(subject.surfaces), context_(context) {
    const Box& box = scene_.object_box();
    scale_ = static_cast<float>(box.size().norm());
    ground_y_ = static_cast<float>(box.min.y());
  }

  /// One row of the view's pixels, from the left. Incomplete once the context is cancelled.
  void paint_row(const PictureCamera& camera, const Vec3f& to_light, int view, int row,
                 std::span<Rgb> out) const {
    std::vector<Ray> rays = rays_of_row(camera, row);
    std::vector<RayHit> hits(rays.size());
    in_packets(rays.size(), [&](std::size_t i, std::size_t n) {
      scene_.intersect(std::span(rays).subspan(i, n), std::span(hits).subspan(i, n),
                       RayOrder::kCoherent);
    });
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
        sums[pixel] += linear_of(options_.background);
      }
    }
    const std::vector<Light> lights = light_of(spots, to_light);
    for (std::size_t i = 0; i < spots.size(); ++i)
      sums[spots[i].pixel] += shade(spots[i], lights[i], to_light);
    for (std::size_t x = 0; x < out.size(); ++x) out[x] = rgb_of(sums[x] / float(kSamples));
  }

 private:
  /// Among millions of slivers, as of a face with as many corners, a packet takes milliseconds.
  template <class Trace>
  void in_packets(std::size_t rays, const Trace& trace) const {
    for (std::size_t i = 0; i < rays && !context_.cancelled(); i += kPacket)
      trace(i, std::min(kPacket, rays - i));
  }

  std::vector<Ray> rays_of_row(const PictureCamera& camera, int row) const {
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
      const PictureSurface& surface = surfaces_[hit.object];
      const Vec3f face = back ? Vec3f(-hit.normal) : hit.normal;
      spot.normal = back ? Vec3f(-surface.normal(hit)) : surface.normal(hit);
      const Vec3f plain = linear_of(options_.surface);
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
    spot.albedo = linear_of(options_.background);
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
    in_packets(rays.size(), [&](std::size_t i, std::size_t n) {
      scene_.occluded(std::span(rays).subspan(i, n), std::span(blocked).subspan(i, n),
                      RayOrder::kCoherent);
    });
    for (std::size_t i = 0; i < rays.size(); ++i)
      lights[i / kKeyRays].key += blocked[i] ? 0.0f : 1.0f / kKeyRays;
    add_sky(spots, lights);
    return lights;
  }

  /// Cosine-distributed, stratified rays; downward rays without a hit reach the ground.
  void add_sky(const std::vector<Spot>& spots, std::vector<Light>& lights) const {
    const auto all = static_cast<std::size_t>(options_.ambient_samples);
    std::vector<Ray> rays(all);
    std::vector<std::uint8_t> blocked(all);
    for (std::size_t i = 0; i < spots.size() && !context_.cancelled(); ++i) {
      // The floor covers most of the picture and has little detail.
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
      // Only the shadow is visible, so that the floor merges with the background.
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
  const std::vector<PictureSurface>& surfaces_;
  const RunContext& context_;
  float scale_ = 1.0f;
  float ground_y_ = 0.0f;
};

}  // namespace

Result<Subject> Subject::create(std::span<const TriangleMesh> meshes, const PictureOptions& options,
                                const RunContext& context) {
  PictureOptions copy = options;
  TURNSCAN_TRY(describe(copy).check());
  TURNSCAN_ASSIGN(Scene scene, Scene::create(meshes, std::nullopt, context));
  Subject subject{std::move(scene), {}, used_vertices(meshes)};
  subject.surfaces.reserve(meshes.size());
  for (const TriangleMesh& mesh : meshes) {
    TURNSCAN_TRY(context.check());
    subject.surfaces.emplace_back(mesh, options.smooth);
  }
  return subject;
}

Vec3f light_for(double azimuth_rad) {
  const double light = azimuth_rad - 0.75, height = 0.7;
  return Vec3d(std::sin(light) * std::cos(height), std::sin(height),
               std::cos(light) * std::cos(height))
      .cast<float>();
}

void paint_view(const Subject& subject, const PictureOptions& options, const ViewSetup& setup,
                int view, std::size_t first_column, ColorImage& image, const RunContext& context) {
  const Painter painter(subject, options, context);
  parallel_for(std::size_t(image.height), 1, [&](std::size_t row) {
    if (context.cancelled()) return;
    const std::size_t first = row * std::size_t(image.width) + first_column;
    painter.paint_row(setup.camera, setup.to_light, view, int(row),
                      std::span(image.pixels).subspan(first, std::size_t(options.width)));
    context.advance();
  });
}

}  // namespace turnscan::rendering
