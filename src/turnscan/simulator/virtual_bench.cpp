#include <algorithm>
#include <cmath>
#include <turnscan/simulator/virtual_bench.hpp>

namespace turnscan {

namespace {

constexpr double kAboveObject_m = 0.04;  // the hand

/// Half the height of the objects above the platter.
double middle_of(const std::vector<TriangleMesh>& objects) {
  double top = 0.0;
  for (const TriangleMesh& mesh : objects)
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t)
        if (v < mesh.vertices.size()) top = std::max(top, double(mesh.vertices[v].y()));
  return std::isfinite(top) ? 0.5 * top : 0.0;
}

void turn(TriangleMesh& mesh, double yaw_rad) {
  if (yaw_rad == 0.0) return;
  const Eigen::Matrix3d R = rotation_about_y(yaw_rad).linear();
  for (Vec3f& p : mesh.vertices) p = (R * p.cast<double>()).cast<float>();
  for (Vec3f& n : mesh.normals) n = (R * n.cast<double>()).cast<float>();
}

}  // namespace

Result<VirtualBench> VirtualBench::create(std::vector<TriangleMesh> objects,
                                          const VirtualScanOptions& options,
                                          const PlatterState& first) {
  VirtualBench bench(options);
  bench.place(std::move(objects), first);
  TURNSCAN_TRY(bench.build_scenes());
  TURNSCAN_TRY(bench.build_room());
  TURNSCAN_TRY(bench.build_hand());
  return bench;
}

void VirtualBench::place(std::vector<TriangleMesh> given, const PlatterState& first) {
  aim_height_m_ = middle_of(given);
  first_travel_ = first.travel;
  const Pose T = table_pose(options_.table);
  T_world_table_ = T;  // the travel of scanner 0 may follow its axis
  yaw_rad_ = canonical_yaw(T, T_world_meant_sensor(0, first_travel_));
  T_world_table_ = T * rotation_about_y(yaw_rad_);
  for (TriangleMesh& mesh : given) turn(mesh, -yaw_rad_);
  turning_ = std::move(given);
  object_count_ = turning_.size();
  ObjectMove move = options_.object_move;
  move.direction_rad -= yaw_rad_;
  T_first_moved_ = moved_objects(move, turning_);
}

Result<> VirtualBench::build_scenes() {
  const PlatterOptions& platter = options_.platter;
  if (platter.visible && platter.thickness_m > 0.0)
    turning_.push_back(platter_body(platter.radius_m, platter.thickness_m));
  const auto disc = platter.visible ? std::optional(platter.radius_m) : std::nullopt;
  TURNSCAN_ASSIGN(scene_, Scene::create(turning_, disc));
  if (!objects_move()) return {};
  TURNSCAN_ASSIGN(objects_alone_, Scene::create(objects()));
  TURNSCAN_ASSIGN(platter_alone_, Scene::create(std::span(turning_).subspan(object_count_), disc));
  return {};
}

Result<> VirtualBench::build_room() {
  if (options_.room.kind == RoomKind::kNone) return {};
  std::vector<Vec3d> places;
  for (std::size_t k = 0; k < options_.scanners.size(); ++k)
    places.push_back(T_world_meant_sensor(k, 0.5).translation());
  standing_.push_back(make_room(options_.room, T_world_table_.translation(),
                                options_.platter.radius_m, options_.platter.thickness_m, places,
                                static_cast<std::uint64_t>(options_.measure.seed)));
  TURNSCAN_ASSIGN(room_, Scene::create(standing_));
  return {};
}

Result<> VirtualBench::build_hand() {
  if (!options_.hand.happens()) return {};
  if (!options_.hand.height_m && object_count_ > 0)
    options_.hand.height_m = 2.0 * aim_height_m_ + kAboveObject_m;
  hand_mesh_.push_back(make_hand());
  TURNSCAN_ASSIGN(hand_, Scene::create(hand_mesh_));
  return {};
}

Pose VirtualBench::T_world_meant_table() const {
  const Pose T = table_pose({});
  return T * rotation_about_y(canonical_yaw(T, T_world_meant_sensor(0, first_travel_)));
}

Pose VirtualBench::T_world_platter(double angle_rad) const {
  Pose sway = Pose::Identity();
  sway.linear() = axis_wobble(options_.motion, angle_rad);
  sway.translation() = axis_runout(options_.motion, angle_rad);
  return T_world_table_ * sway * rotation_about_y(angle_rad);
}

Pose VirtualBench::T_world_objects(const PlatterState& state) const {
  const Pose T = T_world_platter(state.angle_rad);
  if (!objects_move() || state.time_s < options_.object_move.at_s) return T;
  return T * T_first_moved_;
}

Pose VirtualBench::T_world_meant_sensor(std::size_t scanner, double travel) const {
  return scanner_pose(options_.scanners[scanner].placement, aim_height_m_, travel,
                      T_world_table_.linear().col(1));
}

Pose VirtualBench::T_world_sensor(std::size_t scanner, const PlatterState& state) const {
  const ScannerKnock& knock = options_.scanners[scanner].placement.knock;
  const Pose T = T_world_meant_sensor(scanner, state.travel);
  return knock.happens() && state.time_s >= knock.at_s ? T * knock_pose(knock) : T;
}

std::span<const TriangleMesh> VirtualBench::objects() const {
  return std::span(turning_).first(object_count_);
}

std::vector<Body> VirtualBench::bodies_at(const PlatterState& state) const {
  std::vector<Body> bodies{{objects_alone_ ? &*objects_alone_ : &*scene_, T_world_objects(state)}};
  if (room_) bodies.push_back({&*room_, Pose::Identity()});
  if (platter_alone_) bodies.push_back({&*platter_alone_, T_world_platter(state.angle_rad)});
  if (hand_)
    if (const auto T = hand_pose(options_.hand, T_world_table_.translation(), state.time_s))
      bodies.push_back({&*hand_, *T});
  return bodies;
}

std::vector<BodyKind> VirtualBench::kinds() const {
  std::vector<BodyKind> kinds{BodyKind::kObjects};
  if (room_) kinds.push_back(BodyKind::kRoom);
  if (platter_alone_) kinds.push_back(BodyKind::kPlatterAlone);
  if (hand_) kinds.push_back(BodyKind::kHand);
  return kinds;
}

std::vector<std::span<const TriangleMesh>> VirtualBench::meshes() const {
  std::vector<std::span<const TriangleMesh>> meshes{objects_alone_ ? objects()
                                                                   : std::span(turning_)};
  if (room_) meshes.emplace_back(standing_);
  if (platter_alone_) meshes.push_back(std::span(turning_).subspan(object_count_));
  if (hand_) meshes.emplace_back(hand_mesh_);
  return meshes;
}

}  // namespace turnscan
