#pragma once
// The crop at the rate of the frames (thesis algorithm 2). The raw depths of a pixel that lie in
// the cylinder are found once; then a frame costs two comparisons a pixel. It tells returns before
// the cylinder from those behind it: only these say that the space up to there is empty.

#include <cstdint>
#include <turnscan/core/frame.hpp>
#include <turnscan/turntable/crop/crop.hpp>
#include <vector>

namespace turnscan {

class DepthCrop {
 public:
  /// T_table_sensor: with the platter at any angle. Takes about 20 ms for 512 x 424 pixels, on all
  /// cores. Fails with kUnsupported when the sensor gives points, kFormat when its intrinsics are
  /// not usable.
  static Result<DepthCrop> create(const Cylinder& cylinder, const Pose& T_table_sensor,
                                  const SensorInfo& sensor);

  /// Keeps the same pixels as crop() of points_of(). Returns behind the cylinder's far side, or on
  /// rays that miss it, become kOutsideCrop. Returns before its near side become kNoReturn. Throws
  /// std::invalid_argument when the image has not the sensor's size.
  void apply(DepthImage& image) const;

 private:
  DepthCrop() = default;
  std::vector<std::uint16_t> nearest_, farthest_;  ///< raw depths that are kept, per pixel
};

}  // namespace turnscan
