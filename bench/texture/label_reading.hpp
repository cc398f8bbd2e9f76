#pragma once
// Reads the label of builtin:labelled-cylinder in a picture, letter by letter.

#include <map>
#include <turnscan/core/camera.hpp>
#include <turnscan/core/image.hpp>
#include <turnscan/core/pose.hpp>

namespace turnscan::bench {

struct Reading {
  int right = 0, all = 0;
};

/// Per height of the capitals, metres: of the characters that face the camera (within 45 deg), how
/// many are recognised. Each is compared with all characters that there are, dot by dot, where the
/// label has it or half a dot beside: no dictionary, no neighbours. T_camera_label: the label's
/// cylinder stands on y = 0 about the y axis, its front towards +Z.
std::map<double, Reading> read_label(const ColorImage& picture, const CameraIntrinsics& camera,
                                     const Pose& T_camera_label);

}  // namespace turnscan::bench
