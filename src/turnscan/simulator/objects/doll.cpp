#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/implicit_parts.hpp>
#include <turnscan/simulator/objects/object_makers.hpp>

// Lengths in this file are millimetres, up is +y, the face looks along +z.

namespace turnscan::objects {

namespace {

constexpr Rgb kDress{58, 122, 138}, kTrim{238, 226, 202}, kSkin{238, 199, 172}, kHair{108, 68, 44},
    kStraw{224, 192, 130}, kRibbon{180, 58, 54}, kBag{146, 90, 54}, kBowl{226, 222, 214},
    kShoe{56, 46, 50}, kEye{44, 38, 42}, kMouth{188, 84, 82}, kBelt{206, 156, 62};

float skirt_radius(const Vec3f& p) {
  const float up = std::clamp(p.y() / 95.0f, 0.0f, 1.0f);
  const float bell = 15.0f + 31.0f * std::pow(1.0f - up, 1.6f);
  const float fade = std::max(0.0f, 1.0f - p.y() / 85.0f);
  const float pleats =
      1000.0f * float(Doll::pleat_height_m) * fade * std::cos(16.0f * std::atan2(p.x(), p.z()));
  const float bands = 0.9f * (std::exp(-square((p.y() - 10.0f) / 1.8f)) +
                              std::exp(-square((p.y() - 18.0f) / 1.8f)));
  return bell + pleats + bands;
}

void add_dress(const Vec3f& p, Shape& shape) {
  const float slope = 31.0f * 1.6f / 95.0f * (1.0f - std::clamp(p.y() / 95.0f, 0.0f, 1.0f));
  const float side = (std::hypot(p.x(), p.z()) - skirt_radius(p)) / std::hypot(1.0f, slope);
  const float skirt = smooth_max(side, p.y() - 97.0f, 3.0f);
  const bool band = std::abs(p.y() - 10.0f) < 2.4f || std::abs(p.y() - 18.0f) < 2.4f;
  shape.add(skirt, 0.0f, band ? kTrim : kDress);
  // The bodice widens from waist to chest and is flattened from front to back.
  const Vec3f q(p.x(), p.y(), p.z() / 0.8f);
  const float chest = 14.5f + 4.5f * std::clamp((p.y() - 97.0f) / 20.0f, 0.0f, 1.0f);
  shape.add(0.8f * (capsule(q, {0, 97, 0}, {0, 117, 0}, 0.0f) - chest), 4.0f, kDress);
  shape.emboss(std::abs(p.y() - 96.0f) - 3.4f, 1.2f, kBelt);
  if (p.z() > 0.0f) {
    for (const float y : {103.0f, 111.0f, 119.0f})
      shape.emboss(std::hypot(p.x(), p.y() - y) - 2.4f, 1000.0f * float(Doll::button_height_m),
                   kTrim);
  }
  for (const float side_x : {-13.0f, 13.0f}) {
    const Vec3f shoe = (p - Vec3f(side_x, 4.0f, 45.0f)).cwiseQuotient(Vec3f(8.5f, 7.0f, 13.0f));
    shape.add(7.0f * (shoe.norm() - 1.0f), 1.0f, kShoe);
  }
}

void add_face(const Vec3f& p, Shape& shape) {
  if (p.z() < 5.0f) return;
  shape.add(sphere(p, {0, 152.5f, 20.0f}, 2.8f), 2.0f, kSkin);
  for (const float x : {-7.5f, 7.5f}) {
    shape.emboss(1.0f * (std::hypot(p.x() - x, 0.75f * (p.y() - 156.0f)) - 2.3f), 0.8f, kEye);
    shape.emboss(std::hypot(0.5f * (p.x() - x), p.y() - 162.3f - 0.03f * square(p.x() - x)) - 0.9f,
                 0.7f, kHair);
  }
  // The smile is a groove along an arc that follows the surface.
  const float arc = std::hypot(std::hypot(p.x(), p.y() - 153.5f) - 8.5f, shape.d) - 1.0f;
  shape.carve(smooth_max(arc, p.y() - 148.5f, 0.8f), 0.5f, kMouth);
}

float hair(const Vec3f& p) {
  const Vec3f q = p - Vec3f(0, 154, -2);
  const float strands = 0.5f * std::cos(22.0f * std::atan2(q.x(), -q.z())) *
                        std::clamp(std::hypot(q.x(), q.z()) / 10.0f - 0.5f, 0.0f, 1.0f);
  const float ball = q.norm() - 22.4f - strands;
  const float face = std::max(6.0f - p.z(), square(p.x()) / 60.0f + p.y() - 166.0f);
  return 0.9f * smooth_max(ball, -face, 1.5f);
}

void add_hat(const Vec3f& p, Shape& shape) {
  // Tilted back, so that the brim leaves the face free.
  const float c = std::cos(0.14f), s = std::sin(0.14f);
  const Vec3f q(p.x(), c * (p.y() - 170.5f) + s * p.z(), c * p.z() - s * (p.y() - 170.5f));
  const float rho = std::hypot(q.x(), q.z());
  const float wave = 1.6f * std::cos(3.0f * std::atan2(q.x(), q.z())) * square(rho / 34.0f);
  shape.add(0.95f * round_cylinder(rho, q.y() - wave, -1.7f, 1.7f, 34.0f, 1.6f), 0.0f, kStraw);
  const float plaits = 0.25f * std::cos(q.y() * 2.0f) * std::clamp(24.0f - q.y(), 0.0f, 1.0f);
  const float crown = rho * (1.0f + 0.006f * q.y()) - plaits;
  shape.add(0.9f * round_cylinder(crown, q.y(), -8.0f, 28.17f, 21.0f, 8.0f), 3.0f, kStraw);
  shape.emboss(std::max(std::abs(q.y() - 6.5f) - 3.2f, rho - 25.0f), 0.9f, kRibbon);
}

void add_head(const Vec3f& p, Shape& shape) {
  shape.add(capsule(p, {0, 124, 0}, {0, 138, 0}, 7.0f), 3.0f, kSkin);
  shape.add(torus({p.x(), p.z(), p.y() - 132.0f}, 9.0f, 2.2f), 1.5f, kTrim);
  shape.add(sphere({p.x() * 1.04f, p.y(), p.z()}, {0, 152, 0}, 21.0f), 2.0f, kSkin);
  add_face(p, shape);
  shape.add(hair(p), 0.6f, kHair);
  shape.add(sphere(p, {0, 146, -24}, 9.0f), 1.5f, kHair);
  add_hat(p, shape);
}

void add_arm(const Vec3f& p, float side, Shape& shape) {
  const Vec3f shoulder(side * 21, 119, 0), elbow(side * 47, 104, 3), hand(side * 57, 83, 16);
  const float thick = 500.0f * float(Doll::arm_thickness_m);
  shape.add(capsule(p, shoulder, elbow, thick), 2.0f, kSkin);
  shape.add(capsule(p, elbow, hand, thick), 1.5f, kSkin);
  shape.add(sphere(p, shoulder + Vec3f(side * 3, 0, 0), 10.0f), 2.0f, kDress);
  shape.add(sphere(p, hand, 6.2f), 2.0f, kSkin);
}

void add_bag(const Vec3f& p, Shape& shape) {
  const float tube = 500.0f * float(Doll::bag_loop_thickness_m);
  const float ring = 500.0f * float(Doll::bag_loop_hole_m) + tube;
  const Vec3f q = p - Vec3f(57, 72, 17);
  shape.add(torus(q, ring, tube), 1.0f, kBag);
  const Vec3f body = q - Vec3f(0, -19, 0);
  shape.add(round_box(body, {13, 11, 6}, 4.0f), 1.0f, kBag);
  if (body.z() < 0.0f) return;
  shape.emboss(std::hypot(body.x(), body.y() + 2.0f) - 2.5f, 1.2f, kBelt);
}

void add_bowl(const Vec3f& p, Shape& shape) {
  const Vec3f axis = Vec3f(-0.25f, 0.30f, 0.92f).normalized();
  const Vec3f q = p - Vec3f(-59, 74, 24);
  const float along = q.dot(axis), rho = (q - along * axis).norm();
  shape.add(round_cylinder(rho, along, -5.0f, 6.0f, 17.5f, 4.5f), 1.5f, kBowl);
  const float depth = 1000.0f * float(Doll::bowl_depth_m), chord = 12.5f;
  const float radius = (square(chord) + square(depth)) / (2.0f * depth);
  shape.carve(std::hypot(rho, along - 6.0f - radius + depth) - radius, 1.5f, kTrim);
}

Shape doll_at(const Vec3f& p) {
  Shape shape;
  add_dress(p, shape);
  if (shape.near(p, {57, 62, 17}, 32.0f)) add_bag(p, shape);
  if (shape.near(p, {-59, 74, 24}, 20.0f)) add_bowl(p, shape);
  for (const float side : {-1.0f, 1.0f})
    if (shape.near(p, {side * 38, 102, 8}, 38.0f)) add_arm(p, side, shape);
  if (shape.near(p, {0, 164, -2}, 46.0f)) add_head(p, shape);
  shape.d = smooth_max(shape.d, -p.y(), 1.5f);
  return shape;
}

}  // namespace

Result<TriangleMesh> make_doll(const RunContext& context) {
  ImplicitGrid grid;
  // The odd offset keeps the platter's plane off the grid's corners.
  grid.min = 1e-3f * Vec3f(-84.0f, -1.37f, -51.0f);
  grid.max = 1e-3f * Vec3f(78.0f, 204.0f, 64.0f);
  grid.cell = float(Doll::cell_m);
  return mesh_of_shape("doll", doll_at, grid, context);
}

}  // namespace turnscan::objects
