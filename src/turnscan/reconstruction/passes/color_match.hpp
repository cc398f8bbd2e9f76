#pragma once
// How well the colours of two passes fit under a motion.

#include <turnscan/reconstruction/passes/agreement.hpp>

namespace turnscan::passes {

/// What of the differences between the colours of two passes is not the object's: each table's
/// light from above, by the cosine of the angle between normal and axis, up to its square, and one
/// constant (exposure, white balance).
class ShadingFit {
 public:
  struct Pair {
    Vec3f difference;  ///< color of the first minus color of the second
    float up_a, up_b;  ///< cosines between the normals and their tables' axes
    float weight;
  };

  ShadingFit() { coefficients_.setZero(); }
  /// Least squares; differences far beyond `scale` count little (Tukey).
  ShadingFit(std::span<const Pair> pairs, float scale);
  Vec3f at(float up_a, float up_b) const;

 private:
  Eigen::Matrix<float, 5, 3> coefficients_;
};

/// What differences of colour mean between these two passes.
struct ColorScale {
  float spread = 0.0f;  ///< from here on colours are simply different; 0: there is no pattern
  bool any() const { return spread > 0.0f; }
};
ColorScale color_scale(const PreparedPass& a, const PreparedPass& b);

/// How much of the colours a motion explains, over the samples of b that lie on samples of a. A
/// mismatch is the square of a difference over that of the spread, at most 1, after a ShadingFit.
struct ColorAgreement {
  double area_m2 = 0.0;
  double mismatch_m2 = 0.0;   ///< each mismatch times its area
  double unrelated_m2 = 0.0;  ///< what that would be of the same places in another order
  /// What the motion explains, without what it leaves: a large overlap that explains half of it has
  /// no evidence, nor has a place without pattern.
  double evidence_m2() const { return unrelated_m2 - 2.0 * mismatch_m2; }
  /// 1: all of it, 0: no more than by chance. 0 where there is no pattern.
  double explained() const { return unrelated_m2 > 0.0 ? 1.0 - mismatch_m2 / unrelated_m2 : 0.0; }
};
ColorAgreement compare_colors(const PreparedPass& a, const PreparedPass& b, const Pose& T_a_b,
                              const ColorScale& scale, double tolerance_m, Density density);

/// As preference(), of the colours.
double color_preference(const PreparedPass& a, const PreparedPass& b, const Pose& one,
                        const Pose& other, const ColorScale& scale, double tolerance_m);

}  // namespace turnscan::passes
