#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/lens.hpp>

namespace turnscan {

namespace {

constexpr int kMaxUndistortSteps = 200;

constexpr double kMaxSlope = 10.0;  // 84 degrees from the axis

using Distortion = std::array<double, 8>;

BrownConrady<double> unlimited(const Distortion& d) {
  return {d[0], d[1], d[2], d[3], d[4], d[5], d[6], d[7]};
}

Eigen::Vector2d distorted_point(const Distortion& d, double x, double y) {
  distort(BrownConrady<double>{d[0], d[1], d[2], d[3], d[4]}, x, y);
  return {x, y};
}

/// The radial factor of the rational model and its derivative with respect to s = r^2.
struct RadialFactor {
  double value, slope, denominator;
  /// Derivative of the distorted radius r * value with respect to r.
  double growth(double s) const { return value + 2.0 * s * slope; }
  bool covers(double s) const { return denominator > 0.0 && value > 0.0 && growth(s) > 0.0; }
};

RadialFactor radial_factor(const Distortion& d, double s) {
  const double a = 1.0 + s * (d[0] + s * (d[1] + s * d[4])),
               b = 1.0 + s * (d[5] + s * (d[6] + s * d[7]));
  const double da = d[0] + s * (2.0 * d[1] + s * 3.0 * d[4]),
               db = d[5] + s * (2.0 * d[6] + s * 3.0 * d[7]);
  return {a / b, (da * b - a * db) / (b * b), b};
}

/// Interval of radii in which the distorted radius reaches a value.
struct RadiusBracket {
  double low, high;
  bool reached;  ///< false: it does not grow that far; low is where the model ends
};

/// Steps outwards until the distorted radius is reached or stops growing.
RadiusBracket bracket(const Distortion& d, double distorted) {
  constexpr int kSteps = 100;
  const auto covered = [&](double r) { return radial_factor(d, r * r).covers(r * r); };
  const auto distorts_to = [&](double r) { return r * radial_factor(d, r * r).value; };
  for (int i = 1; i <= kSteps; ++i) {
    double low = kMaxSlope * (i - 1) / kSteps, high = kMaxSlope * i / kSteps;
    if (covered(high)) {
      if (distorts_to(high) >= distorted) return {low, high, true};
      continue;
    }
    const double begin = low;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (low + high);
      (covered(middle) ? low : high) = middle;
    }
    const bool reached = distorts_to(low) >= distorted;
    return {reached ? begin : low, low, reached};
  }
  return {kMaxSlope, kMaxSlope, false};
}

/// The radius for which r * factor is `distorted`, by Newton's method between the two bounds.
double undistorted_radius(const Distortion& d, double distorted, double low, double high) {
  double r = 0.5 * (low + high);
  for (int i = 0; i < kMaxUndistortSteps; ++i) {
    const RadialFactor factor = radial_factor(d, r * r);
    const double error = r * factor.value - distorted;
    if (std::abs(error) < 1e-14) break;
    (error < 0.0 ? low : high) = r;
    const double next = r - error / factor.growth(r * r);
    r = next > low && next < high ? next : 0.5 * (low + high);
  }
  return r;
}

/// The derivative of the distorted point with respect to the point.
Eigen::Matrix2d distortion_jacobian(const Distortion& d, double x, double y) {
  const RadialFactor factor = radial_factor(d, x * x + y * y);
  const double p1 = d[2], p2 = d[3], across = 2.0 * (x * y * factor.slope + p1 * x + p2 * y);
  Eigen::Matrix2d J;
  J << factor.value + 2.0 * x * x * factor.slope + 2.0 * p1 * y + 6.0 * p2 * x, across, across,
      factor.value + 2.0 * y * y * factor.slope + 6.0 * p1 * y + 2.0 * p2 * x;
  return J;
}

Vec3d not_covered() { return Vec3d::Constant(std::numeric_limits<double>::quiet_NaN()); }

/// The ray of a rational lens through the distorted point at z = 1; starts with purely radial
/// distortion.
Vec3d rational_ray(const Distortion& d, double xd, double yd) {
  constexpr int kSteps = 30;
  const double distorted = std::hypot(xd, yd);
  const RadiusBracket radius = bracket(d, distorted);
  if (!radius.reached) return not_covered();
  const double r = undistorted_radius(d, distorted, radius.low, radius.high);
  const double scale = distorted > 0.0 ? r / distorted : 1.0;
  double x = xd * scale, y = yd * scale;
  for (int i = 0; i < kSteps; ++i) {
    double u = x, v = y;
    distort_rational(unlimited(d), u, v);
    const Eigen::Vector2d error(u - xd, v - yd);
    if (error.squaredNorm() <= 1e-24) return {x, y, 1.0};
    const Eigen::Matrix2d J = distortion_jacobian(d, x, y);
    const double determinant = J(0, 0) * J(1, 1) - J(0, 1) * J(1, 0);
    x -= (J(1, 1) * error.x() - J(0, 1) * error.y()) / determinant;
    y -= (J(0, 0) * error.y() - J(1, 0) * error.x()) / determinant;
    const double s = x * x + y * y;
    if (!radial_factor(d, s).covers(s)) return not_covered();
  }
  return not_covered();
}

}  // namespace

bool CameraIntrinsics::distorted() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
}

bool CameraIntrinsics::rational() const {
  return distortion[5] != 0.0 || distortion[6] != 0.0 || distortion[7] != 0.0;
}

BrownConrady<double> CameraIntrinsics::lens() const {
  BrownConrady<double> lens = unlimited(distortion);
  if (rational()) {
    const double r = bracket(distortion, std::numeric_limits<double>::infinity()).low;
    lens.largest_r2 = r * r;
  }
  return lens;
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
  if (rational()) return rational_ray(distortion, xd, yd);
  // Converges if the distortion is monotone; strong distortion makes it slow, not wrong.
  double x = xd, y = yd, squared_error = 1.0;
  for (int i = 0; i < kMaxUndistortSteps && squared_error > 1e-20; ++i) {
    const Eigen::Vector2d error = distorted_point(distortion, x, y) - Eigen::Vector2d(xd, yd);
    x -= error.x();
    y -= error.y();
    squared_error = error.squaredNorm();
  }
  if (!(squared_error <= 1e-12)) return not_covered();
  return {x, y, 1.0};
}

Eigen::Vector2d CameraIntrinsics::project(const Vec3d& p_camera) const {
  double x = p_camera.x() / p_camera.z(), y = p_camera.y() / p_camera.z();
  if (rational()) {
    const double s = x * x + y * y;
    if (!radial_factor(distortion, s).covers(s)) return not_covered().head<2>();
    distort_rational(unlimited(distortion), x, y);
    return {fx * x + cx, fy * y + cy};
  }
  const Eigen::Vector2d d = distorted_point(distortion, x, y);
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
