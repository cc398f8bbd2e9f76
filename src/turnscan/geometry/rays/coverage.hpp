#pragma once
// Number of frames that see a point of the surface.

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

struct CoverageOptions {
  double max_incidence_rad = 1.3089969389957472;  ///< 75 deg, between normal and line of sight
  std::uint32_t enough = 5;                       ///< counting stops there; 0 counts all views
  double offset_m = 20e-6;  ///< rays start at this distance outside the surface, along the normal
};

/// For each point the number of views, up to `enough`, that see it: it is in the field of view, its
/// normal is within max_incidence of the line of sight, and the scene does not occlude it. points
/// and normals: table frame, platter at angle 0, as the scene; normals of unit length. Fails with
/// kCancelled; throws std::invalid_argument if the spans differ in length.
Result<std::vector<std::uint32_t>> count_views(
    const Scene& scene, std::span<const CoverageView> views, std::span<const Vec3f> points,
    std::span<const Vec3f> normals, const CoverageOptions& options, const RunContext& context);

/// The views of a sequence, without dropped frames. A frame's pose is its own T_table_sensor, or
/// that of its sensor rotated back by the frame's angle (or by speed times the time since the first
/// frame). Fails with kMissingData if a frame has neither.
Result<std::vector<CoverageView>> views_of(const FrameSequence& sequence);

/// Number of `frames` frames that must see a surface point for it to count as seen: 5, or all but
/// one if there are fewer than 6, and at least one.
std::uint32_t views_needed(std::size_t frames);

/// 1 if a point is seen by views_needed() of the sequence's frames, at an incidence under 75 deg.
/// Shapes, frame and errors as for count_views and views_of.
Result<std::vector<std::uint8_t>> seen_mask(const Scene& scene, const FrameSequence& sequence,
                                            std::span<const Vec3f> points,
                                            std::span<const Vec3f> normals,
                                            const RunContext& context);

}  // namespace turnscan
