#pragma once
// Signed distances of simple parts, in millimetres, and how parts make a coloured shape.

#include <algorithm>
#include <cmath>
#include <string>
#include <turnscan/simulator/objects/implicit_mesh.hpp>

namespace turnscan::objects {

inline float smooth_min(float a, float b, float k) {
  const float h = std::max(k - std::abs(a - b), 0.0f) / k;
  return std::min(a, b) - 0.25f * k * h * h;
}

inline float smooth_max(float a, float b, float k) { return -smooth_min(-a, -b, k); }

inline float square(float x) { return x * x; }

inline float sphere(const Vec3f& p, const Vec3f& centre, float radius) {
  return (p - centre).norm() - radius;
}

/// Less than the distance where the half axes differ, and not steeper than it.
inline float ellipsoid(const Vec3f& p, const Vec3f& centre, const Vec3f& half) {
  const Vec3f q = p - centre;
  const float k = q.cwiseQuotient(half).norm();
  const float slope = q.cwiseQuotient(half.cwiseProduct(half)).norm();
  return slope > 0.0f ? k * (k - 1.0f) / slope : -half.minCoeff();
}

inline float capsule(const Vec3f& p, const Vec3f& a, const Vec3f& b, float radius) {
  const Vec3f along = b - a;
  const float t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0f, 1.0f);
  return (p - a - t * along).norm() - radius;
}

/// From radius_a at a to radius_b at b.
inline float tapered_capsule(const Vec3f& p, const Vec3f& a, const Vec3f& b, float radius_a,
                             float radius_b) {
  const Vec3f along = b - a;
  const float t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0f, 1.0f);
  return (p - a - t * along).norm() - (1.0f - t) * radius_a - t * radius_b;
}

/// Cylinder with rounded edges, at the distance rho from its axis and at a height along it.
inline float round_cylinder(float rho, float along, float low, float high, float radius,
                            float edge) {
  const float r = rho - radius + edge;
  const float y = std::abs(along - 0.5f * (low + high)) - 0.5f * (high - low) + edge;
  return std::min(std::max(r, y), 0.0f) + std::hypot(std::max(r, 0.0f), std::max(y, 0.0f)) - edge;
}

inline float round_box(const Vec3f& p, const Vec3f& half, float edge) {
  const Vec3f q = p.cwiseAbs() - half + Vec3f::Constant(edge);
  return q.cwiseMax(0.0f).norm() + std::min(q.maxCoeff(), 0.0f) - edge;
}

/// Ring in the plane z = 0.
inline float torus(const Vec3f& p, float ring, float tube) {
  return std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - tube;
}

/// Distance so far and what lies nearest, while parts are added.
struct Shape {
  float d = 1e6f;
  Rgb color{};

  void add(float part, float blend, Rgb part_color) {
    if (part < d) color = part_color;
    d = blend > 0.0f ? smooth_min(d, part, blend) : std::min(d, part);
  }

  /// Takes the part away, and paints what shows.
  void carve(float part, float blend, Rgb part_color) {
    if (-part > d - 0.4f) color = part_color;
    d = smooth_max(d, -part, blend);
  }

  /// A patch that stands `height` proud of the surface so far; outline < 0 within it.
  void emboss(float outline, float height, Rgb part_color) {
    add(smooth_max(outline, d - height, 0.8f), 0.3f, part_color);
  }

  /// Whether parts within the ball may change the result, if they blend by at most 6 mm.
  bool near(const Vec3f& p, const Vec3f& centre, float radius) const {
    return sphere(p, centre, radius) < d + 6.0f;
  }
};

/// p in millimetres, on the platter y = 0.
using ShapeAt = Shape (*)(const Vec3f& p);

/// Closed mesh in metres with normals and vertex colours. grid as for mesh_of. Fails with
/// kCancelled.
Result<TriangleMesh> mesh_of_shape(const std::string& name, ShapeAt shape_at,
                                   const ImplicitGrid& grid, const RunContext& context);

}  // namespace turnscan::objects
