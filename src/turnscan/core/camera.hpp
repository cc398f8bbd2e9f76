#pragma once
// Pinhole camera with Brown-Conrady distortion. Camera frame: x right, y down, z forward.

#include <array>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// The centre of the pixel (column, row) has image coordinates u = column, v = row.
struct CameraIntrinsics {
  int width = 0;                                  ///< pixels
  int height = 0;                                 ///< pixels
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< pixels
  /// k1 k2 p1 p2 k3 (Brown 1971, order of OpenCV); all zero: no distortion. Image coordinates are
  /// the distorted ones, as the sensor delivers them.
  std::array<double, 5> distortion{};

  bool distorted() const;
  /// Fails with kFormat unless sizes are in [1, 65535], focal lengths are positive and all finite.
  Result<> check() const;
  /// Direction with z = 1 of the ray through image point (u, v); undoes the distortion by fixed
  /// point iteration. NaN where no ray gives that image point (outside what the distortion model
  /// covers).
  Vec3d ray(double u, double v) const;
  /// Image point of p_camera (z > 0).
  Eigen::Vector2d project(const Vec3d& p_camera) const;
};

/// The directions ray(u, v) of all pixels, row by row: x and y for z = 1.
class RayTable {
 public:
  RayTable() = default;
  explicit RayTable(const CameraIntrinsics& intrinsics);
  const std::vector<float>& x() const { return x_; }
  const std::vector<float>& y() const { return y_; }

 private:
  std::vector<float> x_, y_;
};

}  // namespace turnscan
