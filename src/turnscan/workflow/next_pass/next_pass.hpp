#pragma once
// What a scan did not see, and how the object is to be laid so that the next pass sees most of it.

#include <optional>
#include <string>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/rays/coverage.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <vector>

namespace turnscan {

/// From where a pass was seen.
struct PassViews {
  static constexpr std::size_t kMaxViews = 24;

  std::string name;  ///< of the pass, for people; empty: there is but one
  /// Up to kMaxViews of its frames, evenly spread; in its table's frame, with the turn taken back.
  /// The first is that of its first frame.
  std::vector<CoverageView> views;
  double first_time_s = 0.0;             ///< of its first frame; NaN: unknown
  Pose T_mesh_table = Pose::Identity();  ///< from its table's frame to that of the mesh
};

/// Of the frames that were not dropped, and of this pass if one is given. Fails as frame_poses()
/// does, and with kMissingData without such a frame.
Result<PassViews> pass_views(const FrameSequence& sequence, std::optional<std::uint32_t> pass,
                             std::optional<double> speed_rad_s);

/// Areas of the mesh's surface that no view measured, by the side to which they face as the object
/// lay in the pass.
struct UnseenSurface {
  double surface_m2 = 0.0;    ///< of the whole mesh
  double base_m2 = 0.0;       ///< closed flat on the platter
  double underside_m2 = 0.0;  ///< faces down by more than 30 degrees
  double sides_m2 = 0.0;
  double top_m2 = 0.0;  ///< faces up by more than 30 degrees

  double unseen_m2() const { return base_m2 + underside_m2 + sides_m2 + top_m2; }
};

/// A way to lay the object.
struct NextPose {
  /// How far it is tipped from how it lay in the pass, and to which side its top goes: seen from
  /// above counter-clockwise from the sensor, as that stood at the pass's first frame (90 degrees:
  /// to the right, seen from the sensor).
  double tip_rad = 0.0, towards_rad = 0.0;
  Pose T_table_mesh = Pose::Identity();  ///< then; table frame of the pass, middle above the axis
  double shows_m2 = 0.0;                 ///< of the unseen surface that a turn then sees
  double overlap_m2 = 0.0;               ///< of the measured surface that it sees again
  bool stands = true;                    ///< by itself; false: it has to be propped up
  double lift_m = 0.0;                   ///< see RestingPose
};

struct NextPassAdvice {
  UnseenSurface unseen;
  std::string pass;             ///< PassViews::name of the pass that poses are counted from
  std::vector<NextPose> poses;  ///< best first; empty: none shows more
};

/// The area by what its triangles rest on; up: unit, in the mesh's frame. Zero where the evidence
/// is not known.
UnseenSurface unseen_surface(const ObjectResult& object, const Vec3d& up);

/// Of the poses in which the mesh stands by itself (resting_poses()), those that show unseen
/// surface and see enough of what was measured to be joined with it. Whether a place is seen is
/// found by rays from the pass's views: within 75 degrees of the normal, from two of them at least.
/// Where hardly anything shows so, poses come instead in which the object has to be propped up.
/// nullopt: there is nothing to advise, because the mesh is not closed, it is not known what it
/// rests on, or less than 2 % of the surface were not seen. Fails with kResourceLimit as
/// Scene::create() does, and with kCancelled. Begins the phase "advise".
Result<std::optional<NextPassAdvice>> advise_next_pass(const ObjectResult& object,
                                                       const PassViews& pass,
                                                       const RunContext& context);

/// How a pose turns the object, as it lay at the first frame of the pass, in the frame that the
/// first view's sensor has.
Eigen::Matrix3d turn_seen_by_sensor(const NextPose& pose, const PassViews& pass);

}  // namespace turnscan
