#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/detection/rim_model.hpp>

namespace turnscan::detection {

using Eigen::Vector2d;

RimView::RimView(const CameraIntrinsics& camera, const Plane& plane, const PlaneFrame& frame)
    : camera_(camera),
      plane_(plane),
      frame_(frame),
      u_(frame.u()),
      v_(frame.v()),
      start_(frame.to_plane(Vec3d::Zero())) {}

std::optional<RimView::PlaneRay> RimView::ray(double column, double row) const {
  const Vec3d direction = camera_.ray(column, row);
  const double slope = plane_.normal.dot(direction);
  if (!(slope < -1e-6) || !direction.allFinite()) return std::nullopt;
  return PlaneRay{{u_.dot(direction), v_.dot(direction)}, slope, plane_.offset / slope};
}

/// The height, between the disc and the wall's foot, at which the ray is nearest to the axis: the
/// outline of the cylinder is that of all discs that it consists of.
RimView::OutlineDepth RimView::depth_of_outline(const RimModel& model, const PlaneRay& ray) const {
  const double length2 = ray.along.squaredNorm();
  if (!(length2 > 1e-12)) return {ray.z_plane, false};
  const double nearest = ray.along.dot(model.center - start_) / length2;
  const double foot = (plane_.offset - std::max(0.0, model.thickness_m)) / ray.slope;
  return {std::clamp(nearest, ray.z_plane, foot), nearest >= foot};
}

/// Perspective makes pixels longer with the distance: their mean length between two points is the
/// geometric mean of the lengths there.
double RimView::metres_per_px(const PlaneRay& ray, double z, const Vector2d& out,
                              double to_rim_m) const {
  const auto longest = [&](double depth, const Vector2d& along, double slope) {
    const double across = out.dot(along) / slope;
    const auto step = [&](const Vec3d& d, double focal) {
      const double level = out.x() * u_.dot(d) + out.y() * v_.dot(d);
      return depth * std::abs(level - plane_.normal.dot(d) * across) / focal;
    };
    return std::max(step(Vec3d::UnitX(), camera_.fx), step(Vec3d::UnitY(), camera_.fy));
  };
  const double here = longest(z, ray.along, ray.slope);
  const double z_rim = z + to_rim_m * (out.x() * u_.z() + out.y() * v_.z());
  if (!(z_rim > 0.0)) return 0.0;
  const Vector2d along = (z * ray.along + to_rim_m * out) / z_rim;
  return std::sqrt(here * longest(z_rim, along, z * ray.slope / z_rim));
}

std::optional<OutlineDistance> RimView::outline(const RimModel& model, double column,
                                                double row) const {
  const auto r = ray(column, row);
  if (!r) return std::nullopt;
  const auto [z, at_foot] = depth_of_outline(model, *r);
  const Vector2d away = z * r->along + start_ - model.center;
  const double rho = away.norm();
  if (!(rho > 1e-9)) return std::nullopt;
  const Vector2d out = away / rho;
  const double scale = metres_per_px(*r, z, out, model.radius_m - rho);
  if (!(scale > 1e-9)) return std::nullopt;
  OutlineDistance distance;
  distance.px = (model.radius_m - rho) / scale;
  // The foot moves along the ray by 1 / -slope in z per metre of thickness.
  const double lower = at_foot ? out.dot(r->along) / r->slope : 0.0;
  distance.gradient << out.x() / scale, out.y() / scale, 1.0 / scale, lower / scale;
  distance.bearing_rad = std::atan2(out.y(), out.x());
  return distance;
}

PixelBox RimView::box(const RimModel& model, int margin) const {
  constexpr int kPlaces = 72;
  Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (int k = 0; k < kPlaces; ++k) {
    const double a = kTurn * k / kPlaces;
    const Vec3d top =
        frame_.to_space(model.center + model.radius_m * Vector2d(std::cos(a), std::sin(a)));
    for (const Vec3d& p : {top, Vec3d(top - model.thickness_m * plane_.normal)}) {
      if (!(p.z() > 0.02)) return {0, 0, camera_.width, camera_.height};
      const Vector2d uv = camera_.project(p);
      low = low.cwiseMin(uv);
      high = high.cwiseMax(uv);
    }
  }
  const auto within = [](double value, int size) {
    return static_cast<int>(std::clamp(value, 0.0, double(size)));
  };
  return {within(low.x() - margin, camera_.width), within(low.y() - margin, camera_.height),
          within(high.x() + margin + 1, camera_.width),
          within(high.y() + margin + 1, camera_.height)};
}

std::optional<double> RimView::disc_px(const RimModel& model, double column, double row) const {
  const auto r = ray(column, row);
  if (!r) return std::nullopt;
  const Vector2d away = r->z_plane * r->along + start_ - model.center;
  const double rho = away.norm();
  if (!(rho > 1e-9)) return std::nullopt;
  const double scale = metres_per_px(*r, r->z_plane, away / rho, model.radius_m - rho);
  return scale > 1e-9 ? std::optional((model.radius_m - rho) / scale) : std::nullopt;
}

std::optional<SurfaceDepth> RimView::surface(const RimModel& model, double column,
                                             double row) const {
  const auto r = ray(column, row);
  if (!r) return std::nullopt;
  SurfaceDepth out;
  const double turn =
      std::max(std::abs(plane_.normal.x()) / camera_.fx, std::abs(plane_.normal.y()) / camera_.fy);
  out.z_m = r->z_plane;
  out.slant_m = r->z_plane * turn / -r->slope;
  out.per_pixel_m = out.slant_m;
  const double length = std::hypot(r->along.norm(), r->slope);
  out.facing = -r->slope / length;
  const Vector2d at = r->z_plane * r->along + start_ - model.center;
  const double length2 = r->along.squaredNorm();
  if (at.norm() <= model.radius_m || !(length2 > 1e-12)) return out;
  // The near wall: |at + dz * along| = radius.
  const double half = at.dot(r->along) / length2;
  if (half >= 0.0) return out;  // behind the disc: the wall is not visible
  const double rest = half * half - (at.squaredNorm() - model.radius_m * model.radius_m) / length2;
  const double dz = rest > 0.0 ? -half - std::sqrt(rest) : -half;
  out.wall = true;
  out.z_m = r->z_plane + dz;
  const Vector2d normal = (at + dz * r->along).normalized();
  const double facing = normal.dot(r->along);  // negative towards the sensor
  const double pixel = out.z_m / std::min(camera_.fx, camera_.fy);
  out.facing = std::max(0.0, -facing / length);
  if (rest > 0.0 && facing < -1e-3) {
    out.gradient << normal.x() / facing, normal.y() / facing, 1.0 / facing, 0.0;
    const double across = std::sqrt(std::max(0.0, length2 - facing * facing));
    out.per_pixel_m = pixel * across / -facing;
  } else {
    out.per_pixel_m = 1.0;
  }
  return out;
}

}  // namespace turnscan::detection
