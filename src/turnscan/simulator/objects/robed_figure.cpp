#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/implicit_parts.hpp>
#include <turnscan/simulator/objects/object_makers.hpp>

// Lengths in this file are millimetres, up is +y, the face looks along +z.

namespace turnscan::objects {

namespace {

constexpr Rgb kRobe{222, 216, 202}, kMantle{70, 104, 160}, kFace{236, 200, 176},
    kGilt{206, 168, 74}, kPlinth{140, 120, 98};

/// The robe falls in folds from the shoulders to the plinth.
void add_robe(const Vec3f& p, Shape& shape) {
  const float down = 1.0f - std::clamp(p.y() / 165.0f, 0.0f, 1.0f);
  const float around = std::atan2(p.x(), p.z());
  const float folds = 1000.0f * float(RobedFigure::fold_height_m) * std::min(1.0f, 1.4f * down) *
                      std::cos(9.0f * around + 0.012f * p.y());
  const float in = std::clamp((p.y() - 196.0f) / 34.0f, 0.0f, 1.0f);
  const float radius = 31.0f + 17.0f * std::pow(down, 1.4f) - 21.0f * square(in) + folds;
  const float side = 0.75f * (std::hypot(p.x(), p.z() / 0.85f) - radius);
  shape.add(smooth_max(side, p.y() - 234.0f, 6.0f), 0.0f,
            std::abs(around) < 0.7f ? kRobe : kMantle);
}

/// Sleeves to the hands, which are folded before the breast.
void add_praying_arms(const Vec3f& p, Shape& shape) {
  for (const float side : {-1.0f, 1.0f}) {
    shape.add(tapered_capsule(p, {side * 24, 208, 2}, {side * 33, 168, 18}, 10.0f, 13.0f), 6.0f,
              kMantle);
    shape.add(tapered_capsule(p, {side * 33, 168, 18}, {side * 5, 188, 36}, 13.0f, 8.0f), 4.0f,
              kMantle);
  }
  shape.add(ellipsoid(p, {0, 184, 26}, {18, 18, 14}), 4.0f, kRobe);
  shape.add(tapered_capsule(p, {0, 190, 38}, {0, 212, 42}, 6.0f, 3.0f), 1.5f, kFace);
}

void add_veiled_head(const Vec3f& p, Shape& shape) {
  shape.add(ellipsoid(p, {0, 256, -2}, {19, 24, 19}), 0.0f, kMantle);
  shape.add(tapered_capsule(p, {0, 250, -6}, {0, 216, -8}, 16.0f, 24.0f), 6.0f, kMantle);
  shape.add(ellipsoid(p, {0, 254, 6}, {12, 16, 14}), 1.0f, kFace);
  shape.add(sphere(p, {0, 253, 19.5f}, 2.4f), 1.5f, kFace);
  // It rises from the mantle behind the head.
  const float tube = 500.0f * float(RobedFigure::halo_thickness_m);
  const float ring = 500.0f * float(RobedFigure::halo_diameter_m) - tube;
  shape.add(torus(p - Vec3f(0, 260, -14), ring, tube), 1.0f, kGilt);
}

Shape robed_figure_at(const Vec3f& p) {
  Shape shape;
  add_robe(p, shape);
  shape.add(round_cylinder(std::hypot(p.x(), p.z()), p.y(), -6.0f, 9.0f, 54.0f, 2.0f), 1.0f,
            kPlinth);
  if (shape.near(p, {0, 190, 18}, 62.0f)) add_praying_arms(p, shape);
  if (shape.near(p, {0, 252, -8}, 52.0f)) add_veiled_head(p, shape);
  shape.d = smooth_max(shape.d, -p.y(), 1.0f);
  return shape;
}

}  // namespace

Result<TriangleMesh> make_robed_figure(const RunContext& context) {
  ImplicitGrid grid;
  // The odd offset keeps the platter's plane off the grid's corners.
  grid.min = 1e-3f * Vec3f(-59.0f, -1.37f, -59.0f);
  grid.max = 1e-3f * Vec3f(59.0f, 304.0f, 59.0f);
  grid.cell = float(RobedFigure::cell_m);
  return mesh_of_shape("robed-figure", robed_figure_at, grid, context);
}

}  // namespace turnscan::objects
