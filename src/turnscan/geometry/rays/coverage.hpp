#pragma once
// How many frames see a point of the surface.

#include <cstdint>
#include <optional>
#include <span>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <vector>

namespace turnscan {

/// Where one frame was seen from.
struct CoverageView {
  Pose T_table_sensor = Pose::Identity();  ///< of this frame: the platter's turn taken back
  /// A point counts only if it projects into the image. None: all around (point scanners).
  std::optional<CameraIntrinsics> intrinsics;
  Viewpoint viewpoint;  ///< sensor frame; a camera's is the origin
};

struct CoverageOptions {
  double max_incidence_rad = 1.3089969389957472;  ///< 75 deg, between normal and line of sight
  std::uint32_t enough = 5;                       ///< counting ends there; 0 counts all views
  double offset_m = 20e-6;  ///< rays start so far outside the surface, along the normal
};

/// For each point the number of views, up to `enough`, that see it: it is in the field of view,
/// its normal is within max_incidence of the line of sight, and nothing of the scene lies between.
/// points and normals: table frame, platter at angle 0, as the scene; normals of unit length. Fails
/// with kCancelled; throws std::invalid_argument if the spans differ in length.
Result<std::vector<std::uint32_t>> count_views(
    const Scene& scene, std::span<const CoverageView> views, std::span<const Vec3f> points,
    std::span<const Vec3f> normals, const CoverageOptions& options, const RunContext& context);

/// The views of a sequence, dropped frames left out. A frame's pose is its own T_table_sensor, or
/// that of its sensor turned back by the frame's angle (or by speed times the time since the first
/// frame). Fails with kMissingData when a frame has neither.
Result<std::vector<CoverageView>> views_of(const FrameSequence& sequence);

/// How many of `frames` frames must see a surface point for it to count as seen: 5, or all but one
/// if there are fewer than 6, and at least one.
std::uint32_t views_needed(std::size_t frames);

/// 1 where a point is seen: by views_needed() of the sequence's frames, at an incidence under 75
/// deg. Shapes, frame and errors as for count_views and views_of.
Result<std::vector<std::uint8_t>> seen_mask(const Scene& scene, const FrameSequence& sequence,
                                            std::span<const Vec3f> points,
                                            std::span<const Vec3f> normals,
                                            const RunContext& context);

}  // namespace turnscan
