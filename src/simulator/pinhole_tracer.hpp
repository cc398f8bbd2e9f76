#pragma once
// What the pixels of a pinhole camera see (private to the simulator).

#include <turnscan/core/camera.hpp>
#include <turnscan/simulator/samples.hpp>
#include <vector>

namespace turnscan {

/// The hits of all pixels in rect, row by row; the pixels around it see nothing. A hit's t is the
/// depth along z.
struct Sight {
  PixelRect rect;
  std::vector<RayHit> hits;

  /// nullptr outside rect.
  const RayHit* at(int column, int row) const {
    if (column < rect.left || column >= rect.right || row < rect.top || row >= rect.bottom)
      return nullptr;
    return &hits[std::size_t(row - rect.top) * std::size_t(rect.width()) +
                 std::size_t(column - rect.left)];
  }
};

class PinholeTracer {
 public:
  /// intrinsics.check() must succeed.
  explicit PinholeTracer(const CameraIntrinsics& intrinsics);

  Sight trace(const Scene& scene, const Pose& T_scene_sensor) const;
  /// Through a pixel; its direction has z = 1 in the sensor frame.
  Ray ray(int column, int row, const Pose& T_scene_sensor) const;

 private:
  PixelRect rect_of(const Box& box, const Pose& T_sensor_scene) const;

  CameraIntrinsics camera_;
  RayTable rays_;
};

}  // namespace turnscan
