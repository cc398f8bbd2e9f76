#pragma once
// The images of a frame as an export's layout holds them.

#include <cstdint>
#include <turnscan/core/frame.hpp>
#include <turnscan/geometry/rays/scene.hpp>
#include <turnscan/io/export/posed_images.hpp>
#include <vector>

namespace turnscan::workflow {

/// A camera whose lens the layout has: the recording's, or one without distortion in its place.
class ExportCamera {
 public:
  ExportCamera() = default;
  ExportCamera(const CameraIntrinsics& recorded, exporters::LensModel lens, bool masks);

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  bool resamples() const { return !source_.empty(); }
  /// The image as this camera would have taken it: each pixel is the nearest recorded one.
  template <class T>
  Image<T> image_of(const Image<T>& recorded) const {
    if (!resamples()) return recorded;
    Image<T> out(recorded.width, recorded.height);
    for (std::size_t i = 0; i < source_.size(); ++i)
      if (source_[i] >= 0) out.pixels[i] = recorded.pixels[std::size_t(source_[i])];
    return out;
  }
  /// 255 where a ray meets the scene, else 0. The camera must have been made for masks.
  Image<std::uint8_t> silhouette(const Scene& scene, const Pose& T_world_camera) const;

 private:
  CameraIntrinsics intrinsics_;
  std::vector<std::int32_t> source_;  ///< per pixel the recorded one, -1: none; empty: the same
  RayTable rays_;                     ///< only for masks
};

struct UnitDepth {
  DepthImage image;
  std::size_t measured = 0, lost = 0;  ///< pixels; lost: beyond what 16 bits hold
};
/// Depth in steps of unit_m, with the sensor's bias; 0 where nothing was measured, where it was
/// outside the crop, and where it is lost.
UnitDepth depth_in_unit(const DepthImage& depth, const SensorInfo& sensor, double unit_m);

/// Colour in the pixels of the depth image; black where colour has a camera of its own and there is
/// no depth. Empty if there is no colour. Fails as points_of().
Result<ColorImage> color_of_depth(const Frame& frame, const SensorInfo& sensor,
                                  const RayTable& rays);

}  // namespace turnscan::workflow
