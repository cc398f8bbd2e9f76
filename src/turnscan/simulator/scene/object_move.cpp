#include <algorithm>
#include <turnscan/core/angles.hpp>
#include <turnscan/simulator/scene/object_move.hpp>

namespace turnscan {

namespace {

template <class Visit>
void for_each_corner(std::span<const TriangleMesh> objects, const Visit& visit) {
  for (const TriangleMesh& mesh : objects)
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t)
        if (v < mesh.vertices.size()) visit(mesh.vertices[v].cast<double>());
}

}  // namespace

OptionTable describe(ObjectMove& o) {
  OptionTable table;
  table
      .number("object-move-at", o.at_s, Quantity::kTime, {0.0, 1e5},
              "When the object moves on the platter, if object-move, object-move-turn or "
              "object-move-tip is given.")
      .number("object-move", o.shift_m, Quantity::kLength, {0.0, 1.0},
              "How far it is pushed then; the platter stays.")
      .number("object-move-direction", o.direction_rad, Quantity::kAngle,
              {-2.0 * kTurn, 2.0 * kTurn},
              "To where it is pushed and tipped, around the platter of the first frame as the "
              "azimuth of a scanner.")
      .number("object-move-turn", o.turn_rad, Quantity::kAngle, {-kTurn, kTurn},
              "By how much it turns about the vertical through its middle, counter-clockwise seen "
              "from above.")
      .number("object-move-tip", o.tip_rad, Quantity::kAngle, {0.0, kTurn / 4},
              "By how much it tips over; its lowest point stays on the platter.");
  return table;
}

Pose moved_objects(const ObjectMove& move, std::span<const TriangleMesh> objects) {
  Box box;
  for_each_corner(objects, [&](const Vec3d& p) { box.add(p); });
  if (!move.happens() || box.empty()) return Pose::Identity();
  const Vec3d towards = rotation_about_y(move.direction_rad) * Vec3d(0.0, 0.0, -1.0);
  const Vec3d middle = box.center();
  Pose T = Pose::Identity();
  T.linear() = Eigen::AngleAxisd(move.tip_rad, Vec3d::UnitY().cross(towards)).toRotationMatrix() *
               rotation_about_y(move.turn_rad).linear();
  T.translation() = middle - T.linear() * middle + move.shift_m * towards;
  double low = box.max.y() + box.size().norm();
  for_each_corner(objects, [&](const Vec3d& p) { low = std::min(low, (T * p).y()); });
  T.translation().y() += box.min.y() - low;
  return T;
}

}  // namespace turnscan
