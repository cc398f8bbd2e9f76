#pragma once
// Where what turns ends below, when no platter says it.

#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

struct ObjectBase {
  double height_m = 0.0;  ///< along the axis (unit), from its centre
  bool ends = false;      ///< at a gap; else it spreads into a desk
};

/// Height of the object's lowest points: from its middle
/// down, all surface about the axis that is no wider than what turns belongs to it, also a round
/// foot, which looks at rest, down to a gap or to where it spreads into a desk. Flying pixels,
/// which lie on no surface, do not count. sequence: the one that data was loaded from. In scans of
/// points, which have no background, a two-hundredth of them lie lower. Fails as reading does.
Result<ObjectBase> find_base(const MotionData& data, const TurntableInfo& axis,
                             const FrameSequence& sequence);

}  // namespace turnscan::motion
