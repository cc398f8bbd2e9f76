#pragma once
// Draws scanners and turntable as lines and simple solids (thesis figures 4.2, 4.3 and 5.3).

#include <turnscan/sensors/scanner_model.hpp>
#include <turnscan/simulator/scene/rig.hpp>

#include "view/drawable.hpp"

namespace turnscan::studio {

/// The view frustum from the near to the far end, or to `reach_m`; for a line scanner that part of
/// its light sheet. World frame.
Segments frustum_segments(const ScannerModel& model, const Pose& T_world_sensor, double reach_m);
/// A housing around emitter and receiver; its ridge indicates the up direction.
Segments housing_segments(const ScannerModel& model, const Pose& T_world_sensor, double size_m);
/// Rim and axis of the turntable, and an arrow in the direction of rotation. Table frame.
Segments table_segments(double radius_m, bool clockwise);
/// A ball with vertex colours.
TriangleMesh ball(const Vec3d& center, double radius_m, const Rgb& color);

inline constexpr Rgb kEmitterColor{226, 122, 63};
inline constexpr Rgb kReceiverColor{63, 126, 204};

}  // namespace turnscan::studio
