#pragma once
// How well each frame fits the mesh that all of them made.

#include <cmath>
#include <limits>
#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <vector>

namespace turnscan {

/// Frames that went into a mesh, on their table; they must outlive it.
struct MeshFrames {
  const FrameSequence* frames = nullptr;
  std::optional<std::uint32_t> pass = std::nullopt;  ///< of these alone; nullopt: all
  std::optional<double> speed_rad_s = std::nullopt;  ///< stated; see frame_poses()
  Pose T_mesh_table = Pose::Identity();  ///< from their table's frame to that of the mesh
  std::uint32_t number = 0;              ///< of the pass, for people
};

/// By which motion what a frame measured lies off the mesh, and how far it lies off besides.
struct FrameResidual {
  std::uint32_t frame = 0, sensor = 0, pass = 0;             ///< index and sensor of its FrameInfo
  double time_s = std::numeric_limits<double>::quiet_NaN();  ///< likewise
  Vec3d shift_m = Vec3d::Zero();                             ///< mesh frame
  double turn_m = 0.0;     ///< about +y through the mesh, at its rms distance from that
  double spread_m = 0.0;   ///< of the measurements about that, along the normals: one sigma
  double outward_m = 0.0;  ///< median of the signed distances, positive outside
  Vec3d seen_from = Vec3d::Zero();  ///< position of the sensor, mesh frame; of parallel rays their
                                    ///< direction
  std::size_t points = 0;           ///< that were compared

  /// How far it lies off.
  double off_m() const { return std::hypot(shift_m.norm(), turn_m); }
};

/// Of up to 128 frames, spread evenly, those that show at least 50 points of what was measured of
/// the mesh, in their order. The motion is that of robust least squares over distances along the
/// normals (Y. Chen and G. Medioni, "Object modelling by registration of multiple range images",
/// 1992, equation 7; Huber's weights); what the shape does not determine stays 0. noise_m: of a
/// depth along its ray; points farther off than ten times that, or 10 mm, are of something else,
/// and so are those less than 4 mm, or three times that, above the table. Fails as frame_poses()
/// and reading do, and with kCancelled. The same for any number of threads.
Result<std::vector<FrameResidual>> frame_residuals(const ObjectResult& object,
                                                   const std::vector<MeshFrames>& sources,
                                                   double noise_m, const RunContext& context);

}  // namespace turnscan
