#pragma once
// Fit of each frame to the mesh that was made from all of them.

#include <cmath>
#include <limits>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <vector>

namespace turnscan {

/// Frames that a mesh was made from, posed on their table; they must outlive it.
struct MeshFrames {
  const FrameSequence* frames = nullptr;
  std::optional<std::uint32_t> pass = std::nullopt;  ///< only frames of this pass; nullopt: all
  std::optional<double> speed_rad_s = std::nullopt;  ///< stated; see frame_poses()
  Pose T_mesh_table = Pose::Identity();  ///< from their table's frame to that of the mesh
  std::uint32_t number = 0;              ///< of the pass, as shown to the user
};

/// Rigid offset of a frame from the mesh, and the residual spread.
struct FrameResidual {
  std::uint32_t frame = 0, sensor = 0, pass = 0;             ///< as in its FrameInfo
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< as in its FrameInfo
  Vec3d shift_m = Vec3d::Zero();                             ///< mesh frame
  /// Rotation about +y through the mesh, times the mesh's rms distance from that axis.
  double turn_m = 0.0;
  double spread_m = 0.0;   ///< residual spread of the measurements along the normals: one sigma
  double outward_m = 0.0;  ///< median of the signed distances, positive outside
  /// Position of the sensor, mesh frame; for parallel rays their direction.
  Vec3d seen_from = Vec3d::Zero();
  std::size_t points = 0;  ///< that were compared

  /// Total offset.
  double off_m() const { return std::hypot(shift_m.norm(), turn_m); }
};

/// Evaluates an evenly spaced subset of up to 128 frames; returns those that show at least 50
/// points of the measured part of the mesh, in order. The motion is estimated by robust least
/// squares over distances along the normals (Y. Chen and G. Medioni, "Object modelling by
/// registration of multiple range images", 1992, equation 7; Huber's weights); components that the
/// shape does not determine stay 0. noise_m: of a depth along its ray; points farther away than ten
/// times that, or 10 mm, belong to something else, and so do points less than 4 mm, or three times
/// that, above the table. Fails as frame_poses() and reading do, and with kCancelled. The result is
/// the same for any number of threads.
Result<std::vector<FrameResidual>> frame_residuals(const ObjectResult& object,
                                                   const std::vector<MeshFrames>& sources,
                                                   double noise_m, const RunContext& context);

}  // namespace turnscan
