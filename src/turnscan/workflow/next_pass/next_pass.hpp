#pragma once
// Finds what a scan did not see, and how to place the object so that the next pass sees most of it.

#include <optional>
#include <string>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/rays/coverage.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <vector>

namespace turnscan {

/// The viewpoints of a pass.
struct PassViews {
  static constexpr std::size_t kMaxViews = 24;

  std::string name;  ///< human-readable, of the pass; empty: it is the only one
  /// Up to kMaxViews of its frames, evenly spaced, in the frame of its table with the rotation
  /// removed. The first view is that of the first frame.
  std::vector<CoverageView> views;
  double first_time_s = 0.0;             ///< of its first frame; NaN: not known
  Pose T_mesh_table = Pose::Identity();  ///< from its table's frame to that of the mesh
};

/// Viewpoints of the frames that were not dropped; of this pass only, if one is given. Fails as
/// frame_poses() does, and with kMissingData if there is no such frame.
Result<PassViews> pass_views(const FrameSequence& sequence, std::optional<std::uint32_t> pass,
                             std::optional<double> speed_rad_s);

/// Areas of the mesh's surface that no view measured, by the direction they face in the pose of the
/// pass.
struct UnseenSurface {
  double surface_m2 = 0.0;    ///< of the whole mesh
  double base_m2 = 0.0;       ///< closed flat on the platter
  double underside_m2 = 0.0;  ///< facing down by more than 30 degrees
  double sides_m2 = 0.0;
  double top_m2 = 0.0;  ///< facing up by more than 30 degrees

  double unseen_m2() const { return base_m2 + underside_m2 + sides_m2 + top_m2; }
};

/// A pose in which to place the object for the next pass.
struct NextPose {
  /// Tilt relative to the pose in the pass, and the azimuth towards which the top is tilted: seen
  /// from above, counter-clockwise from the sensor's position at the pass's first frame (90
  /// degrees: to the right, seen from the sensor).
  double tip_rad = 0.0, towards_rad = 0.0;
  /// The resulting pose; table frame of the pass, centre above the axis.
  Pose T_table_mesh = Pose::Identity();
  double shows_m2 = 0.0;    ///< area of unseen surface that becomes visible in one turn
  double overlap_m2 = 0.0;  ///< area of already measured surface that is seen again
  bool stands = true;       ///< stable without support; false: it has to be propped up
  double lift_m = 0.0;      ///< see RestingPose
};

struct NextPassAdvice {
  UnseenSurface unseen;
  std::string pass;             ///< PassViews::name of the pass that the poses are relative to
  std::vector<NextPose> poses;  ///< best first; empty: none shows more
};

/// Areas by the evidence of their triangles; up: unit, in the mesh's frame. Zero if the evidence is
/// not known.
UnseenSurface unseen_surface(const ObjectResult& object, const Vec3d& up);

/// Selects stable poses of the mesh (resting_poses()) that show unseen surface and enough of the
/// measured surface to register the passes. Visibility is determined by rays from the pass's views:
/// within 75 degrees of the normal, from at least two views. If these poses show hardly anything
/// new, poses in which the object has to be propped up are returned instead. nullopt: there is no
/// advice, because the mesh is not closed, its evidence is not known, or less than 2 % of the
/// surface is unseen. Fails with kResourceLimit as Scene::create() does, and with kCancelled.
/// Begins the phase "advise".
Result<std::optional<NextPassAdvice>> advise_next_pass(const ObjectResult& object,
                                                       const PassViews& pass,
                                                       const RunContext& context);

/// Rotation of the object to this pose from that at the pass's first frame, in the sensor frame of
/// the first view.
Eigen::Matrix3d turn_seen_by_sensor(const NextPose& pose, const PassViews& pass);

}  // namespace turnscan
