#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/simulator/color/color_image.hpp>
#include <turnscan/simulator/color/color_response.hpp>

namespace turnscan::sampling {

namespace {

constexpr int kSide = 2;  // samples per pixel along each axis
constexpr float kMirrorExponent = 40.0f;
const Vec3f kPlatterSrgb(140.0f, 142.0f, 146.0f), kPlainSrgb(190.0f, 190.0f, 190.0f);
const Vec3f kNothingThere(28.0f, 30.0f, 34.0f);

/// Random number between -1 and 1.
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
  // A scanner of azimuth 0 is on the side of -Z.
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
  // The sample centres are evenly spaced about that of their pixel.
  camera.width *= kSide, camera.height *= kSide;
  camera.fx *= kSide, camera.fy *= kSide;
  camera.cx = kSide * camera.cx + 0.5 * (kSide - 1);
  camera.cy = kSide * camera.cy + 0.5 * (kSide - 1);
  model.camera = camera;
  TURNSCAN_ASSIGN(SampleTracer tracer, SampleTracer::create(model));
  return ColorCamera(options, std::move(tracer), std::move(meshes));
}

/// A body in the camera's view.
struct ColorCamera::SeenBody {
  Eigen::Matrix3d rotation;  ///< body <- camera
  Vec3d eye;                 ///< body's frame
  Pose T_body_world;
  Eigen::Matrix3f world_rotation;  ///< world <- body
  Vec3f world_translation;
};

/// A sample on a surface that the lamp may illuminate, world.
struct ColorCamera::LampSample {
  int column;  ///< of its pixel
  Vec3f albedo, position, normal;
  float facing;
  bool glossy;
};

/// As SampleTracer::hit_of(), but without what colours do not need.
ColorCamera::LampSample ColorCamera::sample_of(std::span<const Body> bodies,
                                               std::span<const SeenBody> seen,
                                               const SampleGrid& grid, std::size_t i,
                                               const Vec3d& direction) const {
  const std::uint32_t object = grid.object(i), body = grid.body(i);
  const SeenBody& view = seen[body];
  const Vec3d from_eye = double(grid.z[i]) * (view.rotation * direction);
  const bool lamp = options_.lamp != 0.0 || options_.gloss != 0.0;
  LampSample out;
  Vec3d normal = Vec3d::UnitY();
  if (object == kPlatter) {
    out.albedo = SrgbCurve::instance().linear(kPlatterSrgb);
  } else {
    const auto corners = bodies[body].scene->corners(object, grid.triangle[i]);
    const Vec3d a = corners[0].cast<double>();
    const Vec3d ab = corners[1].cast<double>() - a, ac = corners[2].cast<double>() - a;
    const Vec3d n = ab.cross(ac), ap = view.eye + from_eye - a;
    const double over = 1.0 / std::max(n.squaredNorm(), 1e-300);
    out.albedo = SrgbCurve::instance().linear(
        surface_color(meshes_[body][object], grid.triangle[i],
                      std::clamp(float(ap.cross(ac).dot(n) * over), 0.0f, 1.0f),
                      std::clamp(float(ab.cross(ap).dot(n) * over), 0.0f, 1.0f)));
    if (lamp) normal = n.normalized();
  }
  if (!lamp) return out;
  if (normal.dot(from_eye) > 0.0) normal = -normal;
  out.position = view.world_rotation * (view.eye + from_eye).cast<float>() + view.world_translation;
  out.normal = view.world_rotation * normal.cast<float>();
  out.facing = std::max(0.0f, out.normal.dot(to_lamp_));
  out.glossy = object != kPlatter;
  return out;
}

void ColorCamera::cast_shadows(std::span<const Body> bodies, std::span<const SeenBody> seen,
                               std::vector<LampSample>& samples) const {
  std::vector<Ray> rays;
  std::vector<std::uint32_t> of;
  std::vector<std::uint8_t> blocked;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Eigen::Matrix3f rotation = seen[b].T_body_world.linear().cast<float>();
    const Vec3f translation = seen[b].T_body_world.translation().cast<float>();
    Ray ray;
    ray.direction = rotation * to_lamp_;
    rays.clear(), of.clear();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const LampSample& s = samples[i];
      if (s.facing == 0.0f) continue;
      ray.origin = rotation * (s.position + 1e-4f * s.normal) + translation;
      rays.push_back(ray);
      of.push_back(std::uint32_t(i));
    }
    blocked.resize(rays.size());
    bodies[b].scene->occluded(rays, blocked, RayOrder::kCoherent);
    for (std::size_t k = 0; k < of.size(); ++k)
      if (blocked[k] != 0) samples[of[k]].facing = 0.0f;
  }
}

Vec3f ColorCamera::lit(const LampSample& s, const Vec3f& eye_world) const {
  const auto lamp = float(options_.lamp);
  Vec3f light = (1.0f - lamp + lamp * s.facing) * s.albedo;
  if (options_.gloss > 0.0 && s.facing > 0.0f && s.glossy) {
    const Vec3f half = (to_lamp_ + (eye_world - s.position).normalized()).normalized();
    light += Vec3f::Constant(float(options_.gloss) *
                             std::pow(std::max(0.0f, s.normal.dot(half)), kMirrorExponent));
  }
  return light;
}

Image<Vec3f> ColorCamera::light(std::span<const Body> bodies, const Pose& T_world_sensor) const {
  const Pose T_world_color = T_world_sensor * true_T_color_sensor(options_).inverse();
  const Vec3f eye = T_world_color.translation().cast<float>();
  SampleGrid grid;
  tracer_.trace(bodies, T_world_color, grid);
  std::vector<SeenBody> seen;
  for (const Body& body : bodies) {
    const Pose T_body_world = body.T_world_body.inverse(), T = T_body_world * T_world_color;
    seen.push_back({T.linear(), T.translation(), T_body_world,
                    body.T_world_body.linear().cast<float>(),
                    body.T_world_body.translation().cast<float>()});
  }
  const CameraIntrinsics& camera = tracer_.model().camera;  // without distortion
  const Vec3f nothing = SrgbCurve::instance().linear(kNothingThere);
  Image<Vec3f> out(grid.width / kSide, grid.height / kSide, nothing);
  const bool lamp = options_.lamp != 0.0 || options_.gloss != 0.0;
  constexpr float kShare = 1.0f / float(kSide * kSide);
  std::vector<LampSample> samples;
  for (int y = grid.rect.top / kSide; y * kSide < grid.rect.bottom; ++y) {
    samples.clear();
    for (int x = grid.rect.left / kSide; x * kSide < grid.rect.right; ++x) {
      Vec3f& sum = out.at(x, y);
      for (int s = 0; s < kSide * kSide; ++s) {
        const int column = x * kSide + s % kSide, row = y * kSide + s / kSide;
        if (!grid.contains(column, row)) continue;
        const std::size_t i = grid.index(column, row);
        if (!grid.hit(i)) continue;
        const LampSample sample =
            sample_of(bodies, seen, grid, i,
                      {(column - camera.cx) / camera.fx, (row - camera.cy) / camera.fy, 1.0});
        sum -= kShare * nothing;
        if (!lamp) {
          sum += kShare * sample.albedo;
          continue;
        }
        samples.push_back(sample);
        samples.back().column = x;
      }
    }
    cast_shadows(bodies, seen, samples);
    for (const LampSample& sample : samples) out.at(sample.column, y) += kShare * lit(sample, eye);
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
  const SrgbCurve& curve = SrgbCurve::instance();
  const NoiseTable& normal = NoiseTable::instance();
  const auto noise = float(options_.noise);
  for (int y = 0; y < light.height; ++y) {
    const std::uint64_t row_key = hash_key(key, 7, std::uint64_t(y));
    for (int x = 0; x < light.width; ++x) {
      const float dx = float(x) - cx, dy = float(y) - cy;
      const float falloff =
          1.0f - float(options_.vignetting) * (dx * dx + dy * dy) / std::max(corner, 1.0f);
      const Vec3f& from = light.at(x, y);
      std::uint64_t bits = noise > 0.0f ? mix64(row_key ^ std::uint64_t(x)) : 0;
      std::array<std::uint8_t, 3> bytes{};
      for (int c = 0; c < 3; ++c) {
        float value = curve.srgb(falloff * gain[c] * from[c]);
        if (noise > 0.0f) value += noise * normal(bits);
        bits >>= NoiseTable::kBits;
        bytes[std::size_t(c)] = std::uint8_t(std::clamp(value + 0.5f, 0.0f, 255.0f));
      }
      out.at(x, y) = {bytes[0], bytes[1], bytes[2]};
    }
  }
  return out;
}

}  // namespace turnscan::sampling
