#pragma once
// Images and recordings as messages of ROS, laid out as librealsense's recorder and as drivers do.

#include <cstdint>
#include <string>
#include <turnscan/core/frame.hpp>

#include "tests/support/rosbag/ros_bag.hpp"

namespace turnscan::testing {

/// As ROS's library has it.
BagCamera bag_camera(const CameraIntrinsics& camera);
BagPose bag_pose(const Pose& pose);

BagImage depth_image(const DepthImage& depth, const std::string& encoding, double time_s,
                     std::uint32_t seq);
BagImage float_image(const DepthImage& depth, double unit_m, double time_s, std::uint32_t seq);
BagImage color_image(const ColorImage& color, double time_s, std::uint32_t seq);

/// What librealsense says about a device with depth and, where the sensor has a camera of its own
/// for it, colour. T_color_sensor must be rigid.
void put_realsense_facts(ReferenceBag& bag, const SensorInfo& sensor, const std::string& name);

/// The frames of a sequence as a recording of librealsense: numbers go on over dropped ones.
/// first_stamp_s is the device's clock.
void put_realsense(ReferenceBag& bag, const FrameSequence& frames, const std::string& name,
                   double first_stamp_s);

}  // namespace turnscan::testing
