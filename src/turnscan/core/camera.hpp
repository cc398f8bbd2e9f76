#pragma once
// Pinhole camera with Brown-Conrady distortion (core/lens.hpp). Camera frame: x right, y down, z
// forward.

#include <array>
#include <turnscan/core/lens.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan {

/// The centre of the pixel (column, row) has image coordinates u = column, v = row.
struct CameraIntrinsics {
  int width = 0;                                  ///< pixels
  int height = 0;                                 ///< pixels
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< pixels
  /// k1 k2 p1 p2 k3 k4 k5 k6 in the order of OpenCV: Brown 1971, and with k4 to k6 the rational
  /// model of core/lens.hpp. All zero: no distortion. Image coordinates are the distorted ones, as
  /// the sensor delivers them.
  std::array<double, 8> distortion{};

  bool distorted() const;
  bool rational() const;  ///< whether one of k4 to k6 is not zero
  /// The lens for loops over many points. Of a rational one largest_r2 is where the model ends: the
  /// image points of rays farther out would come nearer to the centre again (at most 84 degrees).
  BrownConrady<double> lens() const;
  /// Fails with kFormat unless sizes are in [1, 65535], focal lengths are positive and all finite.
  Result<> check() const;
  /// Direction with z = 1 of the ray through image point (u, v); undoes the distortion by fixed
  /// point iteration, of the rational model by Newton's method. NaN where no ray gives that image
  /// point (outside what the distortion model covers).
  Vec3d ray(double u, double v) const;
  /// Image point of p_camera (z > 0). NaN where the rational model does not cover it: where the
  /// image does not grow with the angle from the axis.
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
