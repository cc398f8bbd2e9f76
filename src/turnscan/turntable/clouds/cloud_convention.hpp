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
/// and ROS write them". to_sensor: from the middle of what is seen.
std::string convention_text(const Vec3d& axis, const Vec3d& to_sensor);

/// A mirrored object whose angles have the opposite sign fits as well as the object itself. Fails
/// with kInvalidOption if clouds lie, in the frame of their scanner, as some programs write them
/// left-handed and others right-handed. middle, reach_m: of what is seen, which does not reach the
/// scanner.
Result<> check_handedness(const SensorInfo& sensor, const Vec3d& axis, const Vec3d& middle,
                          double reach_m);

}  // namespace turnscan::motion
