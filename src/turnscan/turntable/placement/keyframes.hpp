#pragma once
// Keyframes: evenly spread frames that are compared with each other, with their assumed poses.

#include <optional>
#include <turnscan/core/pose.hpp>
#include <turnscan/geometry/estimation/se3.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::placement {

/// Unknowns of one frame: a small rotation about Keyframes::middle times Keyframes::lever_m, then a
/// translation; table frame, metres.
using estimation::Matrix6d;
using estimation::Twist;

/// Data of some frames of a sequence. The vectors have one entry for each of data.frames.
struct Keyframes {
  motion::MotionData data;
  std::vector<std::size_t> positions;  ///< in the sequence, increasing
  std::vector<Pose> T_table_sensor;    ///< as assumed
  Vec3d middle = Vec3d::Zero();        ///< of the object, table frame
  double lever_m = 0.05;               ///< root mean square distance of its points from there

  Matrix6d shown = Matrix6d::Identity();  ///< projects a twist on the subspace that the object's
                                          ///< shape determines

  std::size_t size() const { return positions.size(); }
};

/// Loads the frames at `positions` of the first sensor. nullopt if they show too little of an
/// object. Fails with kCancelled and with the errors of reading.
Result<std::optional<Keyframes>> load_keyframes(const FrameSequence& sequence,
                                                const std::vector<Pose>& T_table_sensor,
                                                std::vector<std::size_t> positions,
                                                PlatterMemory* memory, const RunContext& context);

/// Angle about the table's axis between the viewing directions of two frames.
double turn_between(const Pose& a, const Pose& b);

}  // namespace turnscan::placement
