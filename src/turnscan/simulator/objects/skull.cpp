#include <turnscan/simulator/objects/builtin_objects.hpp>
#include <turnscan/simulator/objects/implicit_parts.hpp>
#include <turnscan/simulator/objects/object_makers.hpp>

// Lengths in this file are millimetres, up is +y, the face looks along +z.

namespace turnscan::objects {

namespace {

constexpr Rgb kBone{224, 212, 186}, kShade{196, 176, 146}, kTeeth{238, 232, 218},
    kSpine{206, 190, 160};

void add_cranium(const Vec3f& p, Shape& shape) {
  shape.add(ellipsoid(p, {0, 97, -12}, {50, 53, 66}), 0.0f, kBone);
  shape.add(ellipsoid(p, {0, 72, 40}, {33, 30, 24}), 6.0f, kBone);
  // Brow and the sides of the face, which the arches leave.
  for (const float side : {-1.0f, 1.0f}) {
    shape.add(capsule(p, {side * 8, 101, 52}, {side * 33, 97, 46}, 6.0f), 5.0f, kBone);
    shape.carve(ellipsoid(p, {side * 54, 68, 20}, {20, 18, 24}), 3.0f, kBone);
  }
}

/// A bar that stands free of the skull's side.
void add_cheekbone(const Vec3f& p, float side, Shape& shape) {
  const float thick = 500.0f * float(Skull::arch_thickness_m);
  const Vec3f q(side * p.x(), p.y(), p.z());
  shape.add(capsule(q, {28, 66, 50}, {50, 66, 34}, thick), 3.0f, kBone);
  shape.add(capsule(q, {50, 66, 34}, {54, 69, 6}, thick), 2.0f, kBone);
  shape.add(capsule(q, {54, 69, 6}, {44, 76, -18}, thick), 2.0f, kBone);
}

void carve_face(const Vec3f& p, Shape& shape) {
  for (const float side : {-1.0f, 1.0f})
    shape.carve(ellipsoid(p, {side * 17, 85, 64}, {12.5f, 11.5f, 30}), 2.0f, kShade);
  const float nose = ellipsoid(p, {0, 70, 66}, {7, 10, 18});
  const float septum = 1.5f - std::abs(p.x());
  shape.carve(smooth_max(nose, septum, 0.8f), 1.0f, kShade);
}

/// An arch of teeth in the plane y = height, open to the back.
float dental_arch(const Vec3f& p, float height, float ring, float tube) {
  const Vec3f q = p - Vec3f(0, height, 30);
  const float round = torus({q.x(), q.z() / 1.15f, q.y()}, ring, tube);
  const float straight = std::hypot(std::abs(q.x()) - ring, q.y()) - tube;
  const float ended = std::max(straight, -q.z() - 16.0f);
  return 0.85f * (q.z() > 0.0f ? round : ended);
}

void add_jaws(const Vec3f& p, Shape& shape) {
  // The mouth reaches far back beneath the palate.
  shape.carve(ellipsoid(p, {0, 36, 24}, {19, 18, 40}), 2.0f, kShade);
  shape.add(dental_arch(p, 47, 23, 5.0f), 3.0f, kTeeth);
  const Vec3f q(std::abs(p.x()), p.y(), p.z());
  shape.add(capsule(q, {0, 6.5f, 64}, {17, 7, 57}, 6.5f), 2.0f, kBone);
  shape.add(capsule(q, {17, 7, 57}, {37, 13, 14}, 6.0f), 2.0f, kBone);
  shape.add(capsule(q, {37, 13, 14}, {42, 22, -8}, 5.5f), 2.0f, kBone);
  shape.add(capsule(q, {42, 22, -8}, {45, 74, -10}, 5.0f), 2.0f, kBone);
  shape.add(capsule(q, {41, 20, -1}, {45, 62, -3}, 5.0f), 3.0f, kBone);
  shape.add(dental_arch(p, 14, 25, 4.5f), 3.0f, kTeeth);
}

Shape skull_at(const Vec3f& p) {
  Shape shape;
  add_cranium(p, shape);
  for (const float side : {-1.0f, 1.0f}) add_cheekbone(p, side, shape);
  carve_face(p, shape);
  add_jaws(p, shape);
  shape.add(capsule(p, {0, 0, -34}, {0, 56, -28}, 11.0f), 4.0f, kSpine);
  shape.d = smooth_max(shape.d, -p.y(), 0.3f);
  return shape;
}

}  // namespace

Result<TriangleMesh> make_skull(const RunContext& context) {
  ImplicitGrid grid;
  // The odd offset keeps the platter's plane off the grid's corners.
  grid.min = 1e-3f * Vec3f(-65.0f, -1.37f, -84.0f);
  grid.max = 1e-3f * Vec3f(65.0f, 155.0f, 80.0f);
  grid.cell = float(Skull::cell_m);
  return mesh_of_shape("skull", skull_at, grid, context);
}

}  // namespace turnscan::objects
