#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/simulator/objects/object_placement.hpp>

namespace turnscan {

namespace {

Result<Box> box_of_triangles(const TriangleMesh& mesh) {
  Box box;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= mesh.vertices.size())
        return fail(ErrorCode::kFormat,
                    "object: triangle {} names vertex {}, but there are {}; repair the mesh", t, v,
                    mesh.vertices.size());
      if (!mesh.vertices[v].allFinite())
        return fail(ErrorCode::kFormat,
                    "object: vertex {} of triangle {} is not finite; repair the mesh", v, t);
      box.add(mesh.vertices[v].cast<double>());
    }
  }
  return box;
}

Result<double> scale_of(const std::optional<double>& height_m, const Box& box) {
  if (!height_m) return 1.0;
  const double height = box.size().y();
  if (!(height > 0.0))
    return fail(ErrorCode::kInvalidOption,
                "object: the mesh is flat in y and cannot be scaled to a height; turn it upright");
  return *height_m / height;
}

void transform(TriangleMesh& mesh, const Pose& T, double scale) {
  for (Vec3f& p : mesh.vertices) p = (T * (scale * p.cast<double>())).cast<float>();
  for (Vec3f& n : mesh.normals) n = (T.linear() * n.cast<double>()).cast<float>();
}

}  // namespace

OptionTable describe(ObjectPlacement& p) {
  OptionTable table;
  table
      .number("height", p.height_m, Quantity::kLength, {1e-4, 100.0},
              "Scale the object to this height; auto: leave its size.")
      .number(
          "tip", p.tip_rad, Quantity::kAngle, {-kTurn, kTurn},
          "Tip the object, its front going down: 180deg puts it on its head, for a second pass.")
      .number("lean", p.lean_rad, Quantity::kAngle, {-kTurn, kTurn},
              "Lean the object, its right side going up.")
      .number("yaw", p.yaw_rad, Quantity::kAngle, {-2.0 * kTurn, 2.0 * kTurn},
              "Turn the object on the platter, counter-clockwise seen from above.")
      .number("object-x", p.x_m, Quantity::kLength, {-10.0, 10.0},
              "How far the middle of the object stands beside the axis, along X.")
      .number("object-z", p.z_m, Quantity::kLength, {-10.0, 10.0},
              "How far the middle of the object stands beside the axis, along Z.");
  return table;
}

Result<PlacedObject> place_object(TriangleMesh mesh, const ObjectPlacement& placement) {
  ObjectPlacement copy = placement;
  TURNSCAN_TRY(describe(copy).check());
  if (mesh.empty())
    return fail(ErrorCode::kTooFewPoints,
                "object: the mesh has no triangles; a scan needs a surface, not points");
  TURNSCAN_ASSIGN(const Box given, box_of_triangles(mesh));
  PlacedObject placed;
  TURNSCAN_ASSIGN(placed.scale, scale_of(placement.height_m, given));
  Pose turned = Pose::Identity();
  turned.linear() = (Eigen::AngleAxisd(placement.tip_rad, Vec3d::UnitX()) *
                     Eigen::AngleAxisd(placement.lean_rad, Vec3d::UnitZ()))
                        .toRotationMatrix();
  Box box;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t)
      box.add(turned * (placed.scale * mesh.vertices[v].cast<double>()));
  Pose set_down = Pose::Identity();
  set_down.translation() = -Vec3d(box.center().x(), box.min.y(), box.center().z());
  Pose moved = rotation_about_y(placement.yaw_rad);
  moved.translation() = Vec3d(placement.x_m, 0.0, placement.z_m);
  placed.T_table_object = moved * set_down * turned;
  transform(mesh, placed.T_table_object, placed.scale);
  placed.mesh = std::move(mesh);
  return placed;
}

}  // namespace turnscan
