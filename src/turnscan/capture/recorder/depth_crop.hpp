#pragma once
// Cropping at the frame rate (thesis algorithm 2). The range of raw depths of each pixel that is
// inside the cylinder is computed once; then a frame costs two comparisons per pixel. Returns in
// front of the cylinder are distinguished from those behind it: only the latter show that the space
// up to there is empty.

#include <cstdint>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <vector>

namespace turnscan {

class DepthCrop {
 public:
  /// T_table_sensor: with the platter at any angle. Takes about 20 ms for 512 x 424 pixels, on all
  /// cores. Fails with kUnsupported if the sensor delivers points, kFormat if its intrinsics are
  /// not usable.
  static Result<DepthCrop> create(const Cylinder& cylinder, const Pose& T_table_sensor,
                                  const SensorInfo& sensor);

  /// Keeps the same pixels as crop() of points_of(). Returns behind the cylinder's far side, or on
  /// rays that miss it, become kOutsideCrop. Returns in front of its near side become kNoReturn.
  /// Throws std::invalid_argument if the image does not have the sensor's size.
  void apply(DepthImage& image) const;

 private:
  DepthCrop() = default;
  std::vector<std::uint16_t> nearest_, farthest_;  ///< range of raw depths to keep, per pixel
};

}  // namespace turnscan
