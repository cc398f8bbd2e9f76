#pragma once
// Which way is up in point clouds, whose axes programs write in different ways.

#include <string>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::motion {

/// 1 if `axis` (unit, sensor frame) points up in the clouds, -1 if down: what is level is seen from
/// above, and sensors stand above rather than below. Where neither shows, 0. A viewpoint inside the
/// clouds is not where the scanner stood: then surfaces, which bulge towards it, show where it was.
double upward(const MotionData& data, const Viewpoint& viewpoint, const Vec3d& axis);

/// How the axes of clouds lie by the turntable's axis, e.g. "the clouds are y down, as PCL, Open3D
/// and ROS write them".
std::string convention_text(const MotionData& data, const Vec3d& axis);

/// For clouds whose angles fit with the opposite sign only: mirrored clouds do so as well as clouds
/// with such angles. Fails with kInvalidOption if they are y up and z forward in the sensor frame,
/// as programs with left-handed axes write them, and others with x left. middle, reach_m: of what
/// is seen, which does not reach the scanner.
Result<> check_handedness(const SensorInfo& sensor, const Vec3d& axis, const Vec3d& middle,
                          double reach_m);

}  // namespace turnscan::motion
