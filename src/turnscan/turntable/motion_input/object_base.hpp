#pragma once
// Where what turns ends below, when no platter says it.

#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// Height along the axis (unit), from its centre, of the object's lowest points. Its foot may be
/// round and look at rest, so that `lowest`, of what was seen to move, is too high: what continues
/// it below, about the axis and no wider, belongs to it, down to a gap or to where it spreads into
/// a desk. sequence: the one that data was loaded from. Scans of points have no background: lowest
/// is right. Fails as reading does.
Result<double> find_base(const MotionData& data, const TurntableInfo& axis,
                         const FrameSequence& sequence, double lowest);

}  // namespace turnscan::motion
