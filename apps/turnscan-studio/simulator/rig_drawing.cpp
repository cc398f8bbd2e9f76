#include "simulator/rig_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <turnscan/core/angles.hpp>

namespace turnscan::studio {

namespace {

constexpr int kCirclePieces = 96;

std::array<Vec3d, 4> corner_rays(const ScannerModel& model) {
  const CameraIntrinsics& c = model.camera;
  // The light sheet of a line scanner has no width.
  const bool line = model.kind == ScannerKind::kLine;
  const double left = line ? c.cx : -0.5, right = line ? c.cx : c.width - 0.5;
  std::array<Vec3d, 4> rays{c.ray(left, -0.5), c.ray(right, -0.5), c.ray(right, c.height - 0.5),
                            c.ray(left, c.height - 0.5)};
  for (Vec3d& ray : rays)
    if (!ray.allFinite()) ray = Vec3d::UnitZ();
  return rays;
}

}  // namespace

Segments frustum_segments(const ScannerModel& model, const Pose& T_world_sensor, double reach_m) {
  Segments lines;
  const auto rays = corner_rays(model);
  const double far = std::max(model.near_m, std::min(model.far_m, reach_m));
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3d &a = rays[i], &b = rays[(i + 1) % 4];
    lines.add(T_world_sensor.translation(), T_world_sensor * Vec3d(model.near_m * a));
    lines.add(T_world_sensor * Vec3d(model.near_m * a), T_world_sensor * Vec3d(far * a));
    lines.add(T_world_sensor * Vec3d(model.near_m * a), T_world_sensor * Vec3d(model.near_m * b));
    lines.add(T_world_sensor * Vec3d(far * a), T_world_sensor * Vec3d(far * b));
  }
  return lines;
}

Segments housing_segments(const ScannerModel& model, const Pose& T_world_sensor, double size_m) {
  Segments lines;
  const double side = 0.3 * size_m;
  const Vec3d low = model.emitter_m.cwiseMin(model.receiver_m) - Vec3d(side, side, 2.0 * side);
  const Vec3d high = model.emitter_m.cwiseMax(model.receiver_m) + Vec3d(side, side, 0.0);
  const auto corner = [&](int i) {
    return Vec3d(T_world_sensor * Vec3d((i & 1) != 0 ? high.x() : low.x(),
                                        (i & 2) != 0 ? high.y() : low.y(),
                                        (i & 4) != 0 ? high.z() : low.z()));
  };
  for (int i = 0; i < 8; ++i)
    for (const int bit : {1, 2, 4})
      if ((i & bit) == 0) lines.add(corner(i), corner(i | bit));
  const Vec3d middle(0.5 * (low.x() + high.x()), low.y() - 0.6 * side, 0.5 * (low.z() + high.z()));
  const Vec3d top = T_world_sensor * middle;
  lines.add(0.5 * (corner(0) + corner(4)), top);
  lines.add(0.5 * (corner(1) + corner(5)), top);
  return lines;
}

Segments table_segments(double radius_m, bool clockwise) {
  Segments lines;
  const auto at = [](double radius, double angle) {
    return Vec3d(radius * std::sin(angle), 0.0, radius * std::cos(angle));
  };
  const double step = kTurn / kCirclePieces;
  for (int i = 0; i < kCirclePieces; ++i)
    lines.add(at(radius_m, i * step), at(radius_m, (i + 1) * step));
  lines.add(Vec3d::Zero(), Vec3d(0.0, 0.6 * radius_m, 0.0));
  const double sign = clockwise ? -1.0 : 1.0;
  for (int i = 0; i < 10; ++i)
    lines.add(at(1.1 * radius_m, sign * i * step), at(1.1 * radius_m, sign * (i + 1) * step));
  const Vec3d tip = at(1.1 * radius_m, sign * 10 * step);
  lines.add(tip, at(1.16 * radius_m, sign * 8.4 * step));
  lines.add(tip, at(1.04 * radius_m, sign * 8.4 * step));
  return lines;
}

TriangleMesh ball(const Vec3d& center, double radius_m, const Rgb& color) {
  TriangleMesh mesh;
  constexpr std::uint32_t kRings = 8, kSides = 12;
  for (std::uint32_t r = 0; r <= kRings; ++r) {
    const double polar = std::numbers::pi * r / kRings;
    for (std::uint32_t s = 0; s < kSides; ++s) {
      const double turn = kTurn * s / kSides;
      const Vec3d way(std::sin(polar) * std::cos(turn), std::cos(polar),
                      -std::sin(polar) * std::sin(turn));
      mesh.vertices.push_back((center + radius_m * way).cast<float>());
      mesh.normals.push_back(way.cast<float>());
      mesh.colors.push_back(color);
      if (r == kRings) continue;
      const std::uint32_t a = r * kSides + s, b = r * kSides + (s + 1) % kSides;
      mesh.triangles.push_back({a, a + kSides, b});
      mesh.triangles.push_back({b, a + kSides, b + kSides});
    }
  }
  return mesh;
}

}  // namespace turnscan::studio
