#pragma once
// Where what turns ends, below and sideways, when no platter says it.

#include <optional>
#include <span>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

struct ObjectBase {
  double height_m = 0.0;  ///< along the axis (unit), from its centre
  /// At a gap or on the surface that what turns stands on; else it spreads into a desk farther
  /// down.
  bool ends = false;
  bool on_surface = false;  ///< it goes down to a surface that was seen: a table or a desk
  /// Largest distance of what turns from the axis; nullopt: hardly a place was seen to turn.
  std::optional<double> reach_m;
};

/// The lowest and the outermost places that turn with the angles, which several frames must have
/// seen: what flickers before a wall or on a desk turns with nothing. What stands still about the
/// axis below them may be the object's round foot, or that of the turntable: it counts as the
/// object where it touches what turns, down to a gap or to where it spreads into a desk. In scans
/// of points, which have no background, nothing does.
/// angles_rad: of data.frames. sequence: the one that data was loaded from. Fails as reading does.
Result<ObjectBase> find_base(const MotionData& data, const TurntableInfo& axis,
                             std::span<const double> angles_rad, const FrameSequence& sequence);

}  // namespace turnscan::motion
