#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <turnscan/turntable/detection/platter_refinement.hpp>

namespace turnscan::detection {

namespace {

constexpr std::size_t kMinSurface = 150;  // pixels
constexpr double kHeightFloor_m = 1e-5;   // residuals do not show the accuracy of a sensor's depth
constexpr double kRoundness = 4e-4;       // relative to the radius: no platter is rounder

std::vector<std::uint8_t> mask_of(const ScanPixels& scan, const Plane& plane, double tolerance) {
  std::vector<std::uint8_t> in(scan.point.size(), 0);
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (scan.still[i] && std::abs(plane.height(scan.point[i].cast<double>())) < tolerance)
      in[i] = 1;
  }
  return in;
}

/// Whether all neighbours of a pixel are in the plane, too: at an edge a filter mixes surfaces.
bool amid_plane(const PlaneView& view, int x, int y, int reach) {
  if (x < reach || y < reach || x + reach >= view.scan.width || y + reach >= view.scan.height)
    return false;
  for (int v = y - reach; v <= y + reach; ++v) {
    for (int u = x - reach; u <= x + reach; ++u)
      if (!view.in[std::size_t(v) * std::size_t(view.scan.width) + std::size_t(u)]) return false;
  }
  return true;
}

/// The pixels of the platter's surface that no edge can have affected.
std::vector<std::int32_t> undisturbed(const PlaneView& view, const RimModel& model, int blur_px,
                                      const RunContext& context) {
  const RimView rays(view.camera, view.plane, view.frame);
  std::vector<std::int32_t> out;
  for (int y = 0; y < view.scan.height && !context.cancelled(); ++y) {
    for (int x = 0; x < view.scan.width; ++x) {
      const int i = y * view.scan.width + x;
      if (!view.in[std::size_t(i)]) continue;
      const auto within = rays.disc_px(model, x, y);
      if (within && *within > 1.5 + blur_px && amid_plane(view, x, y, 1 + blur_px))
        out.push_back(i);
    }
  }
  return out;
}

/// A filter over neighbours favours the brighter ones, which are nearer: the bias is about the
/// change of depth from pixel to pixel, times that change relative to the depth. Along the normal.
double filter_bias(const Plane& plane, const Vec3d& at, const CameraIntrinsics& camera,
                   int blur_px) {
  const double facing = -plane.normal.dot(at) / at.norm();
  const double slant =
      at.z() / std::min(camera.fx, camera.fy) * std::sqrt(1.0 - facing * facing) / facing;
  return blur_px * slant * slant / at.z() * facing;
}

struct Refinement {
  PlaneEstimate plane;
  RimEstimate rim;
  NoiseCorrelation noise;
  Vec3d center = Vec3d::Zero();
  std::size_t pixels = 0;
};

/// Estimates the plane, then the rim in it.
std::optional<Refinement> refine_once(const ScanImage& image, const Refinement& from,
                                      double tolerance_m, std::optional<double> radius_m,
                                      const RunContext& context) {
  RimModel model = from.rim.model;
  model.center.setZero();
  const PlaneView view = view_of(image, from.plane.plane, tolerance_m, from.center);
  const auto own = undisturbed(view, model, from.noise.blur_px, context);
  if (context.cancelled()) return std::nullopt;
  const auto plane = fit_plane(image.pixels, image.rays, own);
  if (!plane || own.size() < kMinSurface) return std::nullopt;
  Refinement out;
  out.plane = *plane;
  out.pixels = own.size();
  out.noise = correlation_of(image.pixels, image.rays, plane->plane, own);
  out.center = from.center * (plane->plane.offset / plane->plane.normal.dot(from.center));
  const PlaneView better = view_of(image, plane->plane, tolerance_m, out.center);
  const auto rim = estimate_rim(better, model, out.noise, radius_m, context);
  if (!rim) return std::nullopt;
  out.rim = *rim;
  out.center = better.frame.to_space(rim->model.center);
  return out;
}

void set_deviations(const Refinement& from, const CameraIntrinsics& camera, DetectedPlatter& p) {
  const Vec3d n = p.axis;
  const Eigen::Matrix3d across = Eigen::Matrix3d::Identity() - n * n.transpose();
  const Eigen::Matrix3d covariance = from.noise.pixels_per_sample * from.plane.covariance;
  const double d = std::abs(from.plane.plane.offset);
  // m = normal / offset: changes perpendicular to its direction rotate the plane.
  p.axis_sigma_rad = d * std::sqrt((across * covariance * across).trace());
  p.height_sigma_m =
      std::hypot(d * std::sqrt(p.center_m.dot(covariance * p.center_m)), kHeightFloor_m,
                 filter_bias(from.plane.plane, p.center_m, camera, from.noise.blur_px));
  // The rim is observed by its direction: if the plane is higher, it is nearer.
  const double lean = (across * p.center_m).norm() / std::abs(n.dot(p.center_m));
  p.center_sigma_m =
      std::sqrt(from.rim.covariance.topLeftCorner<2, 2>().trace() +
                std::pow(lean * p.height_sigma_m, 2) + std::pow(kRoundness * p.radius_m, 2));
  p.radius_sigma_m = std::hypot(std::sqrt(from.rim.covariance(2, 2)), kRoundness * p.radius_m);
}

}  // namespace

PlaneView view_of(const ScanImage& image, const Plane& plane, double tolerance_m,
                  const Vec3d& origin) {
  return {image.pixels,
          image.camera,
          image.rays,
          plane,
          tolerance_m,
          PlaneFrame(plane, origin),
          mask_of(image.pixels, plane, tolerance_m)};
}

std::optional<PlatterCandidate> refine_platter(const ScanImage& image,
                                               const PlatterCandidate& rough,
                                               std::optional<double> radius_m,
                                               const RunContext& context) {
  Refinement start;
  start.plane.plane = {rough.platter.axis, rough.platter.axis.dot(rough.platter.center_m)};
  start.rim.model.radius_m = rough.platter.radius_m;
  start.center = rough.platter.center_m;
  // The noise is known after the first pass.
  const auto first = refine_once(image, start, rough.tolerance_m, radius_m, context);
  if (!first) return std::nullopt;
  const auto last = refine_once(image, *first, rough.tolerance_m, radius_m, context);
  if (!last) return std::nullopt;
  PlatterCandidate out = rough;
  DetectedPlatter& p = out.platter;
  p.axis = last->plane.plane.normal;
  p.center_m = last->center;
  p.radius_m = last->rim.model.radius_m;
  p.plane_rms_m = last->plane.rms_m;
  p.plane_pixels = last->pixels;
  p.rim_points = last->rim.edge_pixels;
  set_deviations(*last, image.camera, p);
  // The pixels around the rim are more informative than the points on it.
  RimCircle circle;
  circle.radius_m = p.radius_m;
  out.support =
      support_of(view_of(image, last->plane.plane, rough.tolerance_m, p.center_m), circle);
  out.support.rim_share = p.rim_share = last->rim.rim_share;
  out.support.agreement = last->rim.agreement;
  p.confidence = last->rim.agreement * out.support.filled;
  return out;
}

}  // namespace turnscan::detection
