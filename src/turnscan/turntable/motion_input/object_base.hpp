#pragma once
// Lower and lateral extent of the turning object when no platter is seen.

#include <optional>
#include <span>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

struct ObjectBase {
  double height_m = 0.0;  ///< along the axis (unit), from its centre
  /// Whether the object ends at a gap or on the surface that it stands on; otherwise it spreads
  /// into a desk farther down.
  bool ends = false;
  bool on_surface = false;  ///< it extends down to a surface that was seen: a table or a desk
  /// Largest distance of the object from the axis; nullopt if hardly any turning point was seen.
  std::optional<double> reach_m;
};

/// The lowest and the outermost points that turn with the angles, which several frames must have
/// seen: what flickers in front of a wall or on a desk turns with nothing. Static surface about the
/// axis below them may be the object's round foot, or that of the turntable: it counts as the
/// object if it touches what turns, down to a gap or to where it spreads into a desk. In point
/// scans, which have no background, no static surface counts.
/// angles_rad: of data.frames. sequence: the one that data was loaded from. Fails as reading does.
Result<ObjectBase> find_base(const MotionData& data, const TurntableInfo& axis,
                             std::span<const double> angles_rad, const FrameSequence& sequence);

}  // namespace turnscan::motion
