#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/implicit_parts.hpp>
#include <turnscan/simulator/objects/object_makers.hpp>

// Lengths in this file are millimetres, up is +y, the face looks along +z.

namespace turnscan::objects {

namespace {

constexpr Rgb kSuit{176, 44, 48}, kSuitDark{44, 66, 122}, kBoot{150, 36, 40}, kGlove{160, 40, 44},
    kVisor{232, 232, 228};

void add_trunk(const Vec3f& p, Shape& shape) {
  shape.add(ellipsoid(p, {0, 48, -18}, {17, 14, 14}), 0.0f, kSuitDark);
  shape.add(tapered_capsule(p, {0, 52, -16}, {0, 96, 8}, 12.0f, 18.0f), 6.0f, kSuit);
  shape.add(capsule(p, {-22, 103, 11}, {22, 103, 11}, 8.5f), 6.0f, kSuit);
  shape.add(capsule(p, {0, 104, 13}, {0, 118, 20}, 6.5f), 3.0f, kSuit);
  shape.add(ellipsoid(p, {0, 131, 24}, {13, 16, 15}), 2.0f, kSuit);
  if (p.z() < 24.0f) return;
  for (const float x : {-5.5f, 5.5f})
    shape.emboss(std::hypot(p.x() - x, 1.4f * (p.y() - 132.0f)) - 4.0f, 0.8f, kVisor);
}

void add_crouched_leg(const Vec3f& p, float side, Shape& shape) {
  const Vec3f hip(side * 12, 46, -18), knee(side * 48, 75, 20), ankle(side * 44, 12, -8);
  const float thick = 500.0f * float(ActionFigure::thigh_thickness_m);
  shape.add(tapered_capsule(p, hip, knee, thick, 7.0f), 4.0f, kSuitDark);
  shape.add(tapered_capsule(p, knee, ankle, 6.8f, 5.5f), 1.5f, kBoot);
  shape.add(capsule(p, ankle - Vec3f(0, 6, 2), {side * 50, 4.5f, 16}, 6.0f), 2.0f, kBoot);
}

void add_limb(const Vec3f& p, const Vec3f& shoulder, const Vec3f& elbow, const Vec3f& hand,
              Shape& shape) {
  const float thin = 500.0f * float(ActionFigure::forearm_thickness_m);
  shape.add(tapered_capsule(p, shoulder, elbow, 7.0f, 5.5f), 3.0f, kSuit);
  shape.add(tapered_capsule(p, elbow, hand, 5.3f, thin), 1.0f, kSuitDark);
  shape.add(sphere(p, hand, 6.5f), 2.0f, kGlove);
}

Shape action_figure_at(const Vec3f& p) {
  Shape shape;
  add_trunk(p, shape);
  for (const float side : {-1.0f, 1.0f})
    if (shape.near(p, {side * 34, 38, 0}, 62.0f)) add_crouched_leg(p, side, shape);
  // One hand on the ground before the feet, the other raised to the side.
  if (shape.near(p, {32, 56, 36}, 66.0f))
    add_limb(p, {24, 103, 11}, {44, 66, 50}, {30, 6, 68}, shape);
  if (shape.near(p, {-54, 116, 6}, 50.0f))
    add_limb(p, {-24, 103, 11}, {-62, 104, -4}, {-80, 138, 8}, shape);
  shape.d = smooth_max(shape.d, -p.y(), 1.0f);
  return shape;
}

}  // namespace

Result<TriangleMesh> make_action_figure(const RunContext& context) {
  ImplicitGrid grid;
  // The odd offset keeps the platter's plane off the grid's corners.
  grid.min = 1e-3f * Vec3f(-92.0f, -1.37f, -40.0f);
  grid.max = 1e-3f * Vec3f(66.0f, 152.0f, 80.0f);
  grid.cell = float(ActionFigure::cell_m);
  return mesh_of_shape("action-figure", action_figure_at, grid, context);
}

}  // namespace turnscan::objects
