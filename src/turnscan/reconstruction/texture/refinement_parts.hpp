#pragma once
// The two kinds of evidence about a colour camera's place, as normal equations of a small motion.

#include <turnscan/geometry/estimation/normal_equations.hpp>
#include <turnscan/geometry/estimation/se3.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>

namespace turnscan::texture {

/// A motion of the camera's frame: turn about its axes (rad), then shift (m).
using Motion = estimation::Twist;

struct MotionEquations : estimation::NormalEquations<6> {
  double error = 0.0;  ///< sum of squared residuals, weighted
  double weight = 0.0;
  void add(const Motion& gradient, double residual, double w);
  void add(const MotionEquations& other);
};

/// How an image point moves with the camera: rows u and v. p: camera's frame.
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

/// A point of the mesh on its outline as a view sees it.
struct OutlinePoint {
  Vec3f p_object;
  Eigen::Vector2f normal;  ///< in the image, away from the mesh
};
std::vector<OutlinePoint> outline_of(const ColorView& view, const DrawnMesh& drawn);

/// How strongly the image changes across the outline when it is shifted, levels a pixel, summed.
double edge_strength(const ColorView& view, const std::vector<OutlinePoint>& outline,
                     const GreyWindow& grey, const Eigen::Vector2f& shift_px);

/// Heights of an object along the turntable's axis, in equal bands.
struct HeightBands {
  static constexpr int kCount = 16;
  double lowest_m = 0.0, height_m = 0.0;
  int of(const Vec3f& p_object) const;
};

struct OutlineEquations : MotionEquations {
  /// What one pixel more of offset all along a band's outline adds to `right`.
  Eigen::Matrix<double, 6, HeightBands::kCount> per_band =
      Eigen::Matrix<double, 6, HeightBands::kCount>::Zero();
  using MotionEquations::add;
  void add(const OutlineEquations& other);
};

/// Of one view: the outline against edges of the image, up to reach_px away.
OutlineEquations outline_equations(const ColorView& view, const std::vector<OutlinePoint>& outline,
                                   const GreyWindow& grey, const HeightBands& bands,
                                   double reach_px);

/// Of all views: points that several see. error: variance of the colours of a place, levels
/// squared.
MotionEquations pattern_equations(const std::vector<ColorView>& views,
                                  const std::vector<DrawnMesh>& drawn,
                                  const std::vector<GreyWindow>& grey,
                                  const std::vector<Vec3f>& points,
                                  const std::vector<Vec3f>& normals);

}  // namespace turnscan::texture
