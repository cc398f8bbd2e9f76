#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/color/color_image.hpp>

namespace turnscan::sampling {

namespace {

constexpr int kSide = 2;  // samples a pixel, each way
constexpr float kMirrorExponent = 40.0f;
const Vec3f kPlatterSrgb(140.0f, 142.0f, 146.0f), kPlainSrgb(190.0f, 190.0f, 190.0f);
const Vec3f kNothingThere(28.0f, 30.0f, 34.0f);

/// IEC 61966-2-1.
float to_linear(float srgb) {
  const float s = srgb / 255.0f;
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

float to_srgb(float linear) {
  if (!(linear > 0.0f)) return 0.0f;
  return 255.0f *
         (linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f);
}

Vec3f linear_color(const Vec3f& srgb) {
  return {to_linear(srgb.x()), to_linear(srgb.y()), to_linear(srgb.z())};
}

/// Between -1 and 1.
double wander(std::uint64_t key) { return 2.0 * uniform01(mix64(key)) - 1.0; }

}  // namespace

Vec3f platter_color() { return kPlatterSrgb; }

Vec3f surface_color(const TriangleMesh& mesh, std::uint32_t triangle, float u, float v) {
  if (has_texture(mesh)) return texture_at(mesh, triangle, u, v);
  if (mesh.colors.size() != mesh.vertices.size()) return kPlainSrgb;
  const auto& t = mesh.triangles[triangle];
  const auto color = [&](std::size_t k) {
    const Rgb c = mesh.colors[t[k]];
    return Vec3f(c.r, c.g, c.b);
  };
  return (1.0f - u - v) * color(0) + u * color(1) + v * color(2);
}

ColorCamera::ColorCamera(const ColorCameraOptions& options, SampleTracer tracer,
                         std::vector<std::span<const TriangleMesh>> meshes)
    : options_(options), tracer_(std::move(tracer)), meshes_(std::move(meshes)) {
  // A scanner of azimuth 0 stands on the side of -Z.
  const Vec3d level = rotation_about_y(options.lamp_azimuth_rad) * Vec3d(0.0, 0.0, -1.0);
  const double up = options.lamp_elevation_rad;
  to_lamp_ = (std::cos(up) * level + std::sin(up) * Vec3d::UnitY()).cast<float>();
}

Result<ColorCamera> ColorCamera::create(const ColorCameraOptions& options,
                                        std::vector<std::span<const TriangleMesh>> meshes) {
  ScannerModel model;
  model.name = "colour camera";
  model.near_m = 1e-3;
  model.far_m = 100.0;
  model.max_incidence_rad = 0.5 * std::numbers::pi;
  CameraIntrinsics camera = intrinsics_of(options);
  // The centres of the samples of a pixel lie evenly about its own.
  camera.width *= kSide, camera.height *= kSide;
  camera.fx *= kSide, camera.fy *= kSide;
  camera.cx = kSide * camera.cx + 0.5 * (kSide - 1);
  camera.cy = kSide * camera.cy + 0.5 * (kSide - 1);
  model.camera = camera;
  TURNSCAN_ASSIGN(SampleTracer tracer, SampleTracer::create(model));
  return ColorCamera(options, std::move(tracer), std::move(meshes));
}

Vec3f ColorCamera::lit(std::span<const Body> bodies, const Samples& samples, std::size_t i,
                       const SampleHit& hit, const Vec3f& eye_world) const {
  const std::uint32_t object = samples.object(i), body = samples.body(i);
  const Vec3f albedo =
      linear_color(object == kPlatter ? kPlatterSrgb
                                      : surface_color(meshes_[body][object], samples.triangle[i],
                                                      float(hit.u), float(hit.v)));
  if (options_.lamp == 0.0 && options_.gloss == 0.0) return albedo;
  const Pose& T = bodies[body].T_world_body;
  const Vec3f p = (T * hit.p_body).cast<float>();
  Vec3f n = (T.linear() * hit.normal_body).cast<float>();
  if (hit.back) n = -n;
  float facing = std::max(0.0f, n.dot(to_lamp_));
  for (const Body& other : bodies) {
    if (facing == 0.0f) break;
    const Pose back = other.T_world_body.inverse();
    Ray ray;
    ray.origin = (back * (p + 1e-4f * n).cast<double>()).cast<float>();
    ray.direction = (back.linear() * to_lamp_.cast<double>()).cast<float>();
    if (other.scene->occluded(ray)) facing = 0.0f;
  }
  const auto lamp = float(options_.lamp);
  Vec3f light = (1.0f - lamp + lamp * facing) * albedo;
  if (options_.gloss > 0.0 && facing > 0.0f && object != kPlatter) {
    const Vec3f half = (to_lamp_ + (eye_world - p).normalized()).normalized();
    light += Vec3f::Constant(float(options_.gloss) *
                             std::pow(std::max(0.0f, n.dot(half)), kMirrorExponent));
  }
  return light;
}

Image<Vec3f> ColorCamera::light(std::span<const Body> bodies, const Pose& T_world_sensor) const {
  const Pose T_world_color = T_world_sensor * true_T_color_sensor(options_).inverse();
  const Vec3f eye = T_world_color.translation().cast<float>();
  SampleGrid grid;
  tracer_.trace(bodies, T_world_color, grid);
  const Vec3f nothing = linear_color(kNothingThere);
  Image<Vec3f> out(grid.width / kSide, grid.height / kSide, Vec3f::Zero());
  constexpr float kShare = 1.0f / float(kSide * kSide);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      Vec3f& sum = out.at(x, y);
      for (int s = 0; s < kSide * kSide; ++s) {
        const int column = x * kSide + s % kSide, row = y * kSide + s / kSide;
        const bool hits = grid.contains(column, row) && grid.hit(grid.index(column, row));
        if (!hits) {
          sum += kShare * nothing;
          continue;
        }
        const std::size_t i = grid.index(column, row);
        const SampleHit hit =
            tracer_.hit_of(bodies, T_world_color, grid, i, tracer_.direction(column, row));
        sum += kShare * lit(bodies, grid, i, hit, eye);
      }
    }
  }
  return out;
}

ColorImage ColorCamera::exposed(const Image<Vec3f>& light, std::uint64_t key) const {
  const double exposure = 1.0 + options_.drift * wander(key);
  const Vec3f gain(float(exposure * (1.0 + options_.white_drift * wander(key + 1))),
                   float(exposure),
                   float(exposure * (1.0 + options_.white_drift * wander(key + 2))));
  ColorImage out(light.width, light.height);
  const float cx = 0.5f * float(light.width - 1), cy = 0.5f * float(light.height - 1);
  const float corner = cx * cx + cy * cy;
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      const float dx = float(x) - cx, dy = float(y) - cy;
      const float falloff =
          1.0f - float(options_.vignetting) * (dx * dx + dy * dy) / std::max(corner, 1.0f);
      const Vec3f& from = light.at(x, y);
      std::array<std::uint8_t, 3> bytes{};
      for (int c = 0; c < 3; ++c) {
        double value = double(to_srgb(falloff * gain[c] * from[c]));
        if (options_.noise > 0.0) {
          const std::uint64_t pixel =
              std::uint64_t(y) * std::uint64_t(light.width) + std::uint64_t(x);
          value += options_.noise * standard_normal(hash_key(key, 7, pixel, std::uint64_t(c)));
        }
        bytes[std::size_t(c)] = std::uint8_t(std::clamp(value + 0.5, 0.0, 255.0));
      }
      out.at(x, y) = {bytes[0], bytes[1], bytes[2]};
    }
  }
  return out;
}

}  // namespace turnscan::sampling
