#include <array>
#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/implicit_parts.hpp>
#include <turnscan/simulator/objects/object_makers.hpp>

// Lengths in this file are millimetres, up is +y, the head is at +z.

namespace turnscan::objects {

namespace {

constexpr Rgb kBack{150, 112, 66}, kPlate{182, 142, 88}, kLeg{196, 160, 104}, kClaw{138, 92, 54},
    kTail{164, 120, 70}, kSting{104, 70, 50}, kLens{60, 52, 48};

void add_body(const Vec3f& p, Shape& shape) {
  const float low = 1000.0f * float(Scorpion::body_clearance_m);
  // Seven plates overlap along the back.
  const float along = (p.z() + 66.0f) / 12.0f;
  const float plates = 0.8f * std::abs(2.0f * (along - std::floor(along)) - 1.0f) *
                       std::clamp((p.y() - 22.0f) / 6.0f, 0.0f, 1.0f);
  shape.add(0.9f * (ellipsoid(p, {0, low + 14, -24}, {27, 14, 44}) - plates), 0.0f, kPlate);
  shape.add(ellipsoid(p, {0, low + 13, 32}, {24, 13, 31}), 4.0f, kBack);
  for (const float x : {-3.5f, 3.5f}) shape.add(sphere(p, {x, low + 26, 36}, 2.0f), 0.8f, kLens);
}

void add_leg(const Vec3f& p, float side, const Vec3f& hip, const Vec3f& knee, const Vec3f& foot,
             Shape& shape) {
  const Vec3f mirrored(side * p.x(), p.y(), p.z());
  const float thick = 500.0f * float(Scorpion::thigh_thickness_m);
  const float thin = 500.0f * float(Scorpion::foot_thickness_m);
  const float middle = 0.5f * (thick + thin);
  const Vec3f ankle = knee + 0.6f * (foot - knee) + Vec3f(2, 2, 0);
  shape.add(tapered_capsule(mirrored, hip, knee, thick, middle), 2.0f, kLeg);
  shape.add(tapered_capsule(mirrored, knee, ankle, middle, 0.5f * (middle + thin)), 1.0f, kLeg);
  shape.add(tapered_capsule(mirrored, ankle, foot, 0.5f * (middle + thin), thin), 1.0f, kLeg);
}

void add_legs(const Vec3f& p, float side, Shape& shape) {
  constexpr std::array<std::array<float, 4>, 4> kLegs{
      // z of hip, knee and foot, x of the foot
      {{36, 50, 70, 84}, {22, 26, 34, 94}, {6, -4, -16, 98}, {-10, -36, -66, 90}}};
  for (const auto& [hip, knee, foot, out] : kLegs)
    add_leg(p, side, {17, 22, hip}, {0.64f * out, 46, knee}, {out, 1.2f, foot}, shape);
}

void add_claw(const Vec3f& p, float side, Shape& shape) {
  const Vec3f q(side * p.x(), p.y(), p.z());
  shape.add(capsule(q, {12, 26, 58}, {44, 36, 82}, 4.0f), 2.0f, kClaw);
  shape.add(capsule(q, {44, 36, 82}, {46, 28, 98}, 4.0f), 1.0f, kClaw);
  shape.add(ellipsoid(q, {44, 25, 107}, {11, 8, 13}), 2.0f, kClaw);
  shape.add(tapered_capsule(q, {50, 24, 115}, {44, 20, 138}, 4.0f, 2.0f), 1.5f, kClaw);
  shape.add(tapered_capsule(q, {37, 24, 115}, {31, 21, 134}, 3.5f, 2.0f), 1.5f, kClaw);
}

void add_tail(const Vec3f& p, Shape& shape) {
  const std::array<Vec3f, 6> joints{Vec3f(0, 28, -62),  Vec3f(0, 44, -92),
                                    Vec3f(0, 78, -104), Vec3f(0, 112, -95.0f),
                                    Vec3f(0, 137, -72), Vec3f(0, 144.2f, -44)};
  for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
    const float thick = 10.0f - 0.6f * float(i);
    shape.add(tapered_capsule(p, joints[i], joints[i + 1], thick, thick - 1.8f), 0.8f, kTail);
  }
  shape.add(ellipsoid(p, {0, 139, -30}, {9, 9, 12}), 2.0f, kSting);
  shape.add(tapered_capsule(p, {0, 134, -20}, {0, 114, -10}, 4.5f, 2.0f), 2.0f, kSting);
}

Shape scorpion_at(const Vec3f& p) {
  Shape shape;
  add_body(p, shape);
  if (shape.near(p, {0, 85, -62}, 82.0f)) add_tail(p, shape);
  for (const float side : {-1.0f, 1.0f}) {
    if (shape.near(p, {side * 33, 28, 98}, 56.0f)) add_claw(p, side, shape);
    if (shape.near(p, {side * 57, 24, 10}, 92.0f)) add_legs(p, side, shape);
  }
  shape.d = smooth_max(shape.d, -p.y(), 0.3f);
  return shape;
}

}  // namespace

Result<TriangleMesh> make_scorpion(const RunContext& context) {
  ImplicitGrid grid;
  // The odd offset keeps the platter's plane off the grid's corners.
  grid.min = 1e-3f * Vec3f(-105.0f, -1.37f, -119.0f);
  grid.max = 1e-3f * Vec3f(105.0f, 155.0f, 145.0f);
  grid.cell = float(Scorpion::cell_m);
  return mesh_of_shape("scorpion", scorpion_at, grid, context);
}

}  // namespace turnscan::objects
