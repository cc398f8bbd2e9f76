#include <turnscan/workflow/export/frame_images.hpp>

#include <cmath>

namespace turnscan::workflow {

namespace {

bool has_lens(const CameraIntrinsics& camera, exporters::LensModel lens) {
  return lens == exporters::LensModel::kRational || !camera.distorted() ||
         (lens == exporters::LensModel::kBrown && !camera.rational());
}

}  // namespace

ExportCamera::ExportCamera(const CameraIntrinsics& recorded, exporters::LensModel lens, bool masks)
    : intrinsics_(recorded) {
  if (!has_lens(recorded, lens)) {
    intrinsics_.distortion = {};
    source_.reserve(std::size_t(recorded.width) * std::size_t(recorded.height));
    for (int row = 0; row < recorded.height; ++row) {
      for (int column = 0; column < recorded.width; ++column) {
        const Eigen::Vector2d uv = recorded.project(intrinsics_.ray(column, row));
        const double u = std::round(uv.x()), v = std::round(uv.y());
        const bool inside = u >= 0 && v >= 0 && u < recorded.width && v < recorded.height;
        source_.push_back(inside ? int(v) * recorded.width + int(u) : -1);
      }
    }
  }
  if (masks) rays_ = RayTable(intrinsics_);
}

Image<std::uint8_t> ExportCamera::silhouette(const Scene& scene, const Pose& T_world_camera) const {
  const int width = intrinsics_.width, height = intrinsics_.height;
  Image<std::uint8_t> out(width, height, 0);
  const Eigen::Matrix3f rotation = T_world_camera.linear().cast<float>();
  std::vector<Ray> rays(std::size_t(width), {T_world_camera.translation().cast<float>()});
  std::vector<std::uint8_t> blocked(rays.size());
  for (int row = 0; row < height; ++row) {
    const std::size_t begin = std::size_t(row) * rays.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const Vec3f direction(rays_.x()[begin + i], rays_.y()[begin + i], 1.0f);
      rays[i].direction = direction.allFinite() ? Vec3f(rotation * direction) : Vec3f::Zero();
    }
    scene.occluded(rays, blocked, RayOrder::kCoherent);
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (blocked[i] != 0 && !rays[i].direction.isZero()) out.pixels[begin + i] = 255;
  }
  return out;
}

UnitDepth depth_in_unit(const DepthImage& depth, const SensorInfo& sensor, double unit_m) {
  UnitDepth out{DepthImage(depth.width, depth.height, kNoReturn)};
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const std::uint16_t raw = depth.pixels[i];
    if (raw == kNoReturn || raw == kOutsideCrop) continue;
    const double steps = std::round((raw * sensor.depth_unit_m + sensor.depth_bias_m) / unit_m);
    ++out.measured;
    if (steps > kNoReturn && steps < kOutsideCrop)
      out.image.pixels[i] = std::uint16_t(steps);
    else
      ++out.lost;
  }
  return out;
}

Result<ColorImage> color_of_depth(const Frame& frame, const SensorInfo& sensor,
                                  const RayTable& rays) {
  const DepthImage& depth = frame.depth;
  if (frame.color.empty()) return ColorImage();
  if (!sensor.color_intrinsics)
    return frame.color.width == depth.width && frame.color.height == depth.height ? frame.color
                                                                                  : ColorImage();
  TURNSCAN_ASSIGN(const FramePoints points, points_of(frame, sensor, rays));
  ColorImage out(depth.width, depth.height);
  for (std::size_t i = 0; i < points.cell.size(); ++i)
    out.pixels[std::size_t(points.cell[i])] = points.cloud.colors[i];
  return out;
}

}  // namespace turnscan::workflow
