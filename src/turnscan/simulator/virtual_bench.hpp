#pragma once
// Poses of table, objects, room and scanners at each moment of a virtual scan.

#include <optional>
#include <span>
#include <turnscan/simulator/virtual_scan.hpp>
#include <vector>

namespace turnscan {

/// Immutable; all members may be called from several threads at once.
class VirtualBench {
 public:
  /// Fails as Scene::create does. first: the platter at the first frame. Precondition: the options
  /// pass check().
  static Result<VirtualBench> create(std::vector<TriangleMesh> objects,
                                     const VirtualScanOptions& options, const PlatterState& first);

  double aim_height_m() const { return aim_height_m_; }
  /// Maps the objects as they were given to the table's frame.
  Pose T_table_given() const { return rotation_about_y(-yaw_rad_); }
  /// With the axis at rest and at angle 0.
  const Pose& T_world_table() const { return T_world_table_; }
  /// The same for the nominal placement of the table.
  Pose T_world_meant_table() const;
  Pose T_world_platter(double angle_rad) const;
  /// Maps from the objects' initial frame: the platter's pose, unless they have moved on it.
  Pose T_world_objects(const PlatterState& state) const;
  Pose T_world_sensor(std::size_t scanner, const PlatterState& state) const;
  /// The pose that the scanner would have without its knock.
  Pose T_world_meant_sensor(std::size_t scanner, double travel) const;

  /// Table frame, at angle 0.
  std::span<const TriangleMesh> objects() const;
  /// Objects, then the body of the platter.
  const Scene& scene() const { return *scene_; }
  const Scene* room() const { return room_ ? &*room_ : nullptr; }

  /// The bodies visible at a moment. kinds() and meshes() describe a body by its index, which is
  /// always the same; the hand, which comes last, is not always there.
  std::vector<Body> bodies_at(const PlatterState& state) const;
  std::vector<BodyKind> kinds() const;
  std::vector<std::span<const TriangleMesh>> meshes() const;

 private:
  explicit VirtualBench(const VirtualScanOptions& options) : options_(options) {}
  void place(std::vector<TriangleMesh> given, const PlatterState& first);
  Result<> build_scenes();
  Result<> build_room();
  Result<> build_hand();
  bool objects_move() const { return options_.object_move.happens(); }

  VirtualScanOptions options_;
  double aim_height_m_ = 0.0, yaw_rad_ = 0.0, first_travel_ = 0.0;
  Pose T_world_table_ = Pose::Identity();
  Pose T_first_moved_ = Pose::Identity();  ///< moves the objects; platter's frame
  std::vector<TriangleMesh> turning_;      ///< objects, then the platter's body; table frame
  std::size_t object_count_ = 0;
  std::vector<TriangleMesh> standing_;  ///< the room; empty without; world
  std::vector<TriangleMesh> hand_mesh_;
  std::optional<Scene> scene_, room_;
  std::optional<Scene> objects_alone_, platter_alone_;  ///< used if the objects move
  std::optional<Scene> hand_;
};

}  // namespace turnscan
