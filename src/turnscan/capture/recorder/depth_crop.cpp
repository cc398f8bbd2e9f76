#include <stdexcept>
#include <turnscan/capture/recorder/depth_crop.hpp>
#include <turnscan/turntable/crop/live_crop.hpp>

namespace turnscan {

Result<DepthCrop> DepthCrop::create(const Cylinder& cylinder, const Pose& T_table_sensor,
                                    const SensorInfo& sensor) {
  TURNSCAN_ASSIGN(const LiveCrop live, LiveCrop::create(sensor, T_table_sensor, cylinder));
  DepthCrop crop;
  for (int row = 0; row < sensor.intrinsics.height; ++row) {
    for (int column = 0; column < sensor.intrinsics.width; ++column) {
      const LiveCrop::Interval kept = live.interval(column, row);
      // A ray that misses the cylinder: every return is outside.
      const bool none = kept.count == 0;
      crop.nearest_.push_back(none ? std::uint16_t(0) : kept.first);
      crop.farthest_.push_back(none ? std::uint16_t(0)
                                    : static_cast<std::uint16_t>(kept.first + kept.count - 1));
    }
  }
  return crop;
}

void DepthCrop::apply(DepthImage& image) const {
  if (image.pixels.size() != nearest_.size())
    throw std::invalid_argument("depth crop: the image has not the sensor's size");
  std::uint16_t* pixels = image.pixels.data();
  for (std::size_t i = 0; i < nearest_.size(); ++i) {
    const std::uint16_t raw = pixels[i];
    const std::uint16_t behind = raw > farthest_[i] ? kOutsideCrop : raw;
    pixels[i] = raw < nearest_[i] ? kNoReturn : behind;
  }
}

}  // namespace turnscan
