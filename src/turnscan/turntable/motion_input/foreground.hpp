#pragma once
// Selects the pixels of a depth image that show the turning object.

#include <optional>
#include <turnscan/turntable/detection/plane_fit.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// The cylinder above the platter, or without a platter the pixels that move.
struct Foreground {
  std::optional<detection::Plane>
      plane;  ///< keep what is above it by the margin, within radius of center
  Vec3d center = Vec3d::Zero();
  double margin_m = 0.0, radius_m = 0.0;
  std::vector<float> nearer_than;                ///< without a plane: see Background
  int left = 0, top = 0, right = 0, bottom = 0;  ///< bounding box in the image

  /// Whether a pixel (its index in the image) that sees p (sensor frame) belongs to the object.
  bool contains(std::size_t pixel, const Vec3f& p) const;
  /// With a plane: whether p is at least radius_m from the axis.
  bool beside(const Vec3f& p) const;
};

/// Determines the foreground from the mean of up to 36 frames spread over the recording: above the
/// platter, else above that of options.hint, else what moves. Also sets the platter and the noise
/// in data, and adds a note if neither platter nor hint is used. Fails with kTooFewPoints if
/// nothing moves, with kCancelled, and with the errors of reading.
Result<Foreground> find_foreground(const FrameSequence& sequence, const MotionDataOptions& options,
                                   MotionData& data, const RunContext& context);

}  // namespace turnscan::motion
