#include "bench/texture/pixel_kinds.hpp"

#include <turnscan/core/parallel.hpp>

namespace turnscan::bench {

namespace {

constexpr int kStep = 3, kReach = 2;
constexpr float kFlatCosine = 0.5f, kStepOfDepth = 6.0f;

class Looker {
 public:
  Looker(const VirtualScan& scan, const CameraIntrinsics& camera, const Pose& T_object_camera,
         const std::vector<Vec3d>& eyes)
      : scan_(scan), camera_(camera), T_(T_object_camera), eyes_(eyes) {}

  PixelKind at(int x, int y) const {
    const RayHit hit = hit_of(x, y);
    if (!on_object(hit)) return PixelKind::kNone;
    for (const auto& [dx, dy] : {std::pair{-kReach, 0}, {kReach, 0}, {0, -kReach}, {0, kReach}}) {
      const RayHit other = hit_of(x + dx, y + dy);
      const float most = kStepOfDepth * kReach * hit.t / float(camera_.fx);
      if (!on_object(other) || std::abs(other.t - hit.t) > most) return PixelKind::kRim;
    }
    const Ray ray = ray_of(x, y);
    const Vec3f p = ray.origin + hit.t * ray.direction + 1e-4f * hit.normal;
    float best = 0.0f;
    for (const Vec3d& eye : eyes_) {
      const Vec3f to_eye = (eye - p.cast<double>()).cast<float>();
      const float cosine = hit.normal.dot(to_eye.normalized());
      if (cosine > best && !scan_.scene().occluded(Ray{p, to_eye})) best = cosine;
    }
    if (!(best > 0.0f)) return PixelKind::kUnseen;
    return best < kFlatCosine ? PixelKind::kFlat : PixelKind::kWell;
  }

 private:
  Ray ray_of(int x, int y) const {
    Ray ray;
    ray.origin = T_.translation().cast<float>();
    ray.direction = (T_.linear() * camera_.ray(x, y)).normalized().cast<float>();
    return ray;
  }
  RayHit hit_of(int x, int y) const { return scan_.scene().intersect(ray_of(x, y)); }
  bool on_object(const RayHit& hit) const {
    return hit.valid() && hit.object < scan_.objects().size();
  }

  const VirtualScan& scan_;
  const CameraIntrinsics& camera_;
  const Pose& T_;
  const std::vector<Vec3d>& eyes_;
};

}  // namespace

std::vector<Pose> color_cameras(const VirtualScan& scan, const ColorCameraOptions& camera) {
  std::vector<Pose> out;
  for (std::size_t i = 0; i < scan.frames().size(); ++i)
    out.push_back(scan.T_table_sensor(i) * true_T_color_sensor(camera).inverse());
  return out;
}

Image<PixelKind> pixel_kinds(const VirtualScan& scan, const ColorCameraOptions& camera,
                             const Pose& T_object_camera, const std::vector<Vec3d>& eyes) {
  const CameraIntrinsics intrinsics = intrinsics_of(camera);
  const Looker looker(scan, intrinsics, T_object_camera, eyes);
  Image<PixelKind> out(intrinsics.width, intrinsics.height, PixelKind::kNone);
  parallel_for(std::size_t(intrinsics.height / kStep), 1, [&](std::size_t row) {
    for (int x = 0; x < intrinsics.width; x += kStep)
      out.at(x, int(row) * kStep) = looker.at(x, int(row) * kStep);
  });
  return out;
}

}  // namespace turnscan::bench
