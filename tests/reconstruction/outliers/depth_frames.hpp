#pragma once
// Depth frames made by formula, and those of the data sets, for the outlier filter's tests and
// benchmark.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <turnscan/core/frame.hpp>
#include <vector>

namespace turnscan::testing {

CameraIntrinsics kinect_v2();
/// The same with the distortion of a real one (iai_kinect2, 001530565347), rounded.
CameraIntrinsics distorted_kinect_v2();

/// Depth in metres along the ray with direction (x, y, 1) of a pixel; 0 where there is none.
using DepthAt = std::function<double(int column, int row, double x, double y)>;
/// Points of a frame, raw depth in steps of depth_unit_m.
FramePoints render(const CameraIntrinsics& camera, const DepthAt& depth,
                   double depth_unit_m = 1e-4);

struct Defects {
  double noise_m = 0.0015;  ///< standard deviation of depth
  double holes = 0.02;      ///< share of pixels without a return
  double flying = 0.5;      ///< share of silhouette pixels that are mixed with what lies behind
  double flying_m = 0.08;   ///< how far they reach behind the edge
  std::uint64_t seed = 1;
};

/// A doll-like thing of about 6000 pixels in 0.9 m, alone (as after the crop).
FramePoints object_frame(const CameraIntrinsics& camera, const Defects& defects = {});
/// The same in front of walls and a floor: a return in nearly every pixel.
FramePoints room_frame(const CameraIntrinsics& camera, const Defects& defects = {});

/// Points in a random order of cells.
FramePoints shuffled(const FramePoints& frame, std::uint64_t seed);

/// A frame of the data sets and what it is called.
struct NamedFrame {
  std::string name;
  FramePoints points;
};
/// Folder of the data sets (TURNSCAN_TEST_DATA, or ../shared/data from the project's root), if any.
std::optional<std::string> data_folder();
/// Real depth images: kinect1_room (each stride-th), d435_bear, kinect2. Empty when there are none.
std::vector<NamedFrame> real_depth_frames(int stride);
/// The range scans of stanford_bunny, as seen along parallel rays.
std::vector<NamedFrame> real_range_scans();

}  // namespace turnscan::testing
