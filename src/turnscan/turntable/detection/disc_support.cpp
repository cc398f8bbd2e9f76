#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/detection/disc_support.hpp>

namespace turnscan::detection {

namespace {

using Eigen::Vector2d;

constexpr int kPlaces = 360;

}  // namespace

DiscSupport support_of(const PlaneView& view, const RimCircle& circle) {
  const auto side_at = [&](const Vector2d& q) -> std::optional<int> {
    const Vec3d p = view.frame.to_space(q);
    if (!(p.z() > 0.0)) return std::nullopt;
    const Vector2d uv = view.camera.project(p);
    const int x = int(std::lround(uv.x())), y = int(std::lround(uv.y()));
    if (x < 0 || y < 0 || x >= view.scan.width || y >= view.scan.height) return std::nullopt;
    // Flickering pixels, on a turning object or an edge, are inconclusive.
    const auto i = std::size_t(y) * std::size_t(view.scan.width) + std::size_t(x);
    if (!view.scan.still[i] && view.scan.point[i].z() > 0.0f) return std::nullopt;
    // Surface nearer than anything that the sensor measures is out of its range.
    if (!(view.scan.point[i].z() > 0.0f) && p.z() < view.scan.nearest_m) return std::nullopt;
    return view.side(x, y);
  };
  /// If the disc has no return, it may be dark or in a shadow.
  const auto returned_at = [&](const Vector2d& q) -> std::optional<int> {
    const Vector2d uv = view.camera.project(view.frame.to_space(q));
    const auto side = side_at(q);
    if (!side || *side >= 0) return side;
    const auto i = std::size_t(std::lround(uv.y())) * std::size_t(view.scan.width) +
                   std::size_t(std::lround(uv.x()));
    return view.scan.point[i].z() > 0.0f ? side : std::nullopt;
  };
  /// Radial length of this many pixels at a point of the rim.
  const auto pixels = [&](const Vector2d& direction, double count) {
    const Vec3d a = view.frame.to_space(circle.center + circle.radius_m * direction);
    const Vec3d b = view.frame.to_space(circle.center + (circle.radius_m + 1e-4) * direction);
    const double moved = (view.camera.project(b) - view.camera.project(a)).norm();
    return moved > 1e-9 ? std::min(count * 1e-4 / moved, 0.5 * circle.radius_m) : 0.0;
  };
  DiscSupport out;
  double agree = 0.0, against = 0.0, in = 0.0, behind = 0.0, all = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const double a = kTurn * k / kPlaces;
    const Vector2d direction(std::cos(a), std::sin(a));
    const double step = pixels(direction, 2.5);
    const auto inner = returned_at(circle.center + (circle.radius_m - step) * direction);
    const auto outer = side_at(circle.center + (circle.radius_m + step) * direction);
    if (inner && outer) {
      if (*inner == 0 && *outer < 0) agree += 1.0;
      if ((*inner == 0 && *outer == 0) || *inner < 0) against += 1.0;
    }
    for (int ring = 0; ring < 10; ++ring) {
      const double r = (circle.radius_m - step) * std::sqrt((ring + 0.5) / 10.0);
      const auto side = returned_at(circle.center + r * direction);
      all += 1.0;
      if (side && *side == 0) in += 1.0;
      if (side && *side < 0) behind += 1.0;
    }
  }
  out.rim_share = agree / kPlaces;
  out.agreement = agree + against > 0.0 ? agree / (agree + against) : 0.0;
  out.filled = in + behind > 0.0 ? in / (in + behind) : 0.0;
  out.seen = (in + behind) / all;
  return out;
}

}  // namespace turnscan::detection
