#pragma once
// What frames see of a surface, and how much they tell of it.

#include <cstdint>
#include <optional>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <vector>

namespace turnscan {

/// Viewpoint of one frame.
struct CoverageView {
  Pose T_table_sensor = Pose::Identity();  ///< of this frame: the platter's rotation compensated
  /// A point is seen only if it projects into the image. nullopt: all directions (point scanners).
  std::optional<CameraIntrinsics> intrinsics;
  Viewpoint viewpoint;  ///< sensor frame; a camera's is the origin
};

/// What a place needs to count as seen: what one view at 60 degrees of incidence tells, or four at
/// 75 degrees. It is the same for a handful of scans and for a thousand frames.
inline constexpr double kSeenInformation = 0.25;

struct CoverageOptions {
  double max_incidence_rad = 1.3089969389957472;  ///< 75 deg, between normal and line of sight
  double enough = kSeenInformation;               ///< the sum stops there; 0: at no sum
  double offset_m = 20e-6;  ///< rays start at this distance outside the surface, along the normal
};

/// For each point the sum, up to `enough`, of the squared cosines of incidence of the views that
/// see it: what they tell of its position along its normal, relative to one view seen head-on (the
/// inverse variance of a depth along the ray, projected onto the normal). A view sees a point that
/// is in its field of view, whose normal is within max_incidence of the line of sight, and that the
/// scene does not occlude. points and normals: table frame, platter at angle 0, as the scene;
/// normals of unit length. Fails with kCancelled; throws std::invalid_argument if the spans differ
/// in length.
Result<std::vector<float>> view_information(const Scene& scene, std::span<const CoverageView> views,
                                            std::span<const Vec3f> points,
                                            std::span<const Vec3f> normals,
                                            const CoverageOptions& options,
                                            const RunContext& context);

/// The view of a sensor with this pose.
CoverageView view_of(const SensorInfo& sensor, const Pose& T_table_sensor);

/// The views of a sequence, without dropped frames. A frame's pose is its own T_table_sensor, or
/// that of its sensor rotated back by the frame's angle (or by speed times the time since the first
/// frame). Fails with kMissingData if a frame has neither.
Result<std::vector<CoverageView>> views_of(const FrameSequence& sequence);

/// 1 if the sequence's frames tell at least kSeenInformation of a point. Shapes, frame and errors
/// as for view_information and views_of.
Result<std::vector<std::uint8_t>> seen_mask(const Scene& scene, const FrameSequence& sequence,
                                            std::span<const Vec3f> points,
                                            std::span<const Vec3f> normals,
                                            const RunContext& context);

}  // namespace turnscan
