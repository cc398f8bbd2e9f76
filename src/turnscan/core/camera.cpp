#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/lens.hpp>

namespace turnscan {

namespace {

constexpr int kMaxUndistortSteps = 200;

Eigen::Vector2d distorted_point(const std::array<double, 5>& d, double x, double y) {
  distort(BrownConrady<double>{d[0], d[1], d[2], d[3], d[4]}, x, y);
  return {x, y};
}

}  // namespace

bool CameraIntrinsics::distorted() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
}

Result<> CameraIntrinsics::check() const {
  if (width < 1 || height < 1 || width > 65535 || height > 65535)
    return fail(ErrorCode::kFormat, "intrinsics: image size {} x {} is not within 1..65535", width,
                height);
  const bool finite =
      std::isfinite(fx) && std::isfinite(fy) && std::isfinite(cx) && std::isfinite(cy) &&
      std::all_of(distortion.begin(), distortion.end(), [](double k) { return std::isfinite(k); });
  if (!finite || !(fx > 0.0) || !(fy > 0.0))
    return fail(ErrorCode::kFormat,
                "intrinsics: fx = {}, fy = {}, cx = {}, cy = {} and distortion must be finite, "
                "focal lengths positive",
                fx, fy, cx, cy);
  return {};
}

Vec3d CameraIntrinsics::ray(double u, double v) const {
  const double xd = (u - cx) / fx, yd = (v - cy) / fy;
  if (!distorted()) return {xd, yd, 1.0};
  // Converges where the distortion is monotone; strong distortion makes it slow, not wrong.
  double x = xd, y = yd, squared_error = 1.0;
  for (int i = 0; i < kMaxUndistortSteps && squared_error > 1e-20; ++i) {
    const Eigen::Vector2d error = distorted_point(distortion, x, y) - Eigen::Vector2d(xd, yd);
    x -= error.x();
    y -= error.y();
    squared_error = error.squaredNorm();
  }
  if (!(squared_error <= 1e-12)) return Vec3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return {x, y, 1.0};
}

Eigen::Vector2d CameraIntrinsics::project(const Vec3d& p_camera) const {
  const Eigen::Vector2d d =
      distorted_point(distortion, p_camera.x() / p_camera.z(), p_camera.y() / p_camera.z());
  return {fx * d.x() + cx, fy * d.y() + cy};
}

RayTable::RayTable(const CameraIntrinsics& intrinsics) {
  const std::size_t n = std::size_t(intrinsics.width) * std::size_t(intrinsics.height);
  x_.reserve(n);
  y_.reserve(n);
  for (int v = 0; v < intrinsics.height; ++v) {
    for (int u = 0; u < intrinsics.width; ++u) {
      const Vec3d d = intrinsics.ray(u, v);
      x_.push_back(static_cast<float>(d.x()));
      y_.push_back(static_cast<float>(d.y()));
    }
  }
}

}  // namespace turnscan
