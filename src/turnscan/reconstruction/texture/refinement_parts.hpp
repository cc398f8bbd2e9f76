#pragma once
// The two kinds of evidence for a colour camera's pose, as normal equations of a small motion.

#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/geometry/estimation/se3.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>

namespace turnscan::texture {

/// A motion of the camera's frame: rotation about its axes (rad), then translation (m).
using Motion = estimation::Twist;

struct MotionEquations : estimation::NormalEquations<6> {
  double error = 0.0;  ///< sum of squared residuals, weighted
  double weight = 0.0;
  void add(const Motion& gradient, double residual, double w);
  void add(const MotionEquations& other);
};

/// Derivative of an image point by the camera's motion: rows u and v. p: camera's frame.
Eigen::Matrix<double, 2, 6> image_motion(const Vec3f& p, const CameraIntrinsics& camera);

/// Luminance of a part of an image, blurred.
struct GreyWindow {
  int left = 0, top = 0;
  Image<float> light;
  /// Bilinear value and gradient at an image point; false outside.
  bool at(float u, float v, float& value, Eigen::Vector2f& gradient) const;
};

/// Gaussian blur, sigma in pixels.
GreyWindow blurred(const GreyWindow& window, double sigma);

/// A point of the mesh on its outline in a view.
struct OutlinePoint {
  Vec3f p_object;
  Eigen::Vector2f normal;  ///< in the image, away from the mesh
};
std::vector<OutlinePoint> outline_of(const ColorView& view, const DrawnMesh& drawn);

/// Strength of the image's gradient across the outline shifted by shift_px, levels per pixel,
/// summed.
double edge_strength(const ColorView& view, const std::vector<OutlinePoint>& outline,
                     const GreyWindow& grey, const Eigen::Vector2f& shift_px);

/// Divides an object along the turntable's axis into equal bands.
struct HeightBands {
  static constexpr int kCount = 16;
  double lowest_m = 0.0, height_m = 0.0;
  int of(const Vec3f& p_object) const;
};

struct OutlineEquations : MotionEquations {
  /// Contribution to `right` of an additional offset of one pixel all along a band's outline.
  Eigen::Matrix<double, 6, HeightBands::kCount> per_band =
      Eigen::Matrix<double, 6, HeightBands::kCount>::Zero();
  using MotionEquations::add;
  void add(const OutlineEquations& other);
};

/// Equations of one view: matches the outline to edges of the image, up to reach_px away.
OutlineEquations outline_equations(const ColorView& view, const std::vector<OutlinePoint>& outline,
                                   const GreyWindow& grey, const HeightBands& bands,
                                   double reach_px);

/// Equations of all views for points that several see. error: variance of the colours of a point,
/// levels squared.
MotionEquations pattern_equations(const std::vector<ColorView>& views,
                                  const std::vector<DrawnMesh>& drawn,
                                  const std::vector<GreyWindow>& grey,
                                  const std::vector<Vec3f>& points,
                                  const std::vector<Vec3f>& normals);

}  // namespace turnscan::texture
