#pragma once
// Places of a turning object's surface. Internal to turntable: not installed.

#include <turnscan/turntable/motion_solve.hpp>

namespace turnscan::detail {

/// Sensor frame at angle 0, metres; n is a unit vector.
struct SurfacePlace {
  Vec3d p, n;
};

/// Means of the key frames' samples that share a cell and a side, about `most` of them; what was
/// seen at a low angle, by few, or from all sides (a rim), is left out.
std::vector<SurfacePlace> surface_places(const MotionData& data, const MotionState& state,
                                         std::size_t most);

}  // namespace turnscan::detail
