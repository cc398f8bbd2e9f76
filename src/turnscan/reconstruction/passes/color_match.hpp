#pragma once
// Agreement of the colours of two passes under a motion.

#include <turnscan/reconstruction/passes/agreement.hpp>

namespace turnscan::passes {

/// Model of the colour differences between two passes that are not the object's: each table's light
/// from above, by the cosine of the angle between normal and axis, up to its square, and one
/// constant (exposure, white balance).
class ShadingFit {
 public:
  struct Pair {
    Vec3f difference;  ///< color of the first minus color of the second
    float up_a, up_b;  ///< cosines between the normals and their tables' axes
    float weight;
  };

  ShadingFit() { coefficients_.setZero(); }
  /// Least squares; differences far beyond `scale` have little weight (Tukey).
  ShadingFit(std::span<const Pair> pairs, float scale);
  Vec3f at(float up_a, float up_b) const;

 private:
  Eigen::Matrix<float, 5, 3> coefficients_;
};

/// Scale of colour differences between two passes.
struct ColorScale {
  float spread = 0.0f;  ///< difference from which colours are simply different; 0: there is no
                        ///< pattern
  bool any() const { return spread > 0.0f; }
};
ColorScale color_scale(const PreparedPass& a, const PreparedPass& b);

/// How well a motion explains the colours, over the samples of b that coincide with samples of a. A
/// mismatch is the squared difference over the squared spread, at most 1, after a ShadingFit.
struct ColorAgreement {
  double area_m2 = 0.0;
  double mismatch_m2 = 0.0;   ///< each mismatch times its area
  double unrelated_m2 = 0.0;  ///< expectation of it for the same points in another order
  /// What the motion explains minus what it leaves unexplained: a large overlap of which half is
  /// explained has no evidence, nor has a region without pattern.
  double evidence_m2() const { return unrelated_m2 - 2.0 * mismatch_m2; }
  /// 1: everything is explained, 0: no more than by chance. 0 if there is no pattern.
  double explained() const { return unrelated_m2 > 0.0 ? 1.0 - mismatch_m2 / unrelated_m2 : 0.0; }
};
ColorAgreement compare_colors(const PreparedPass& a, const PreparedPass& b, const Pose& T_a_b,
                              const ColorScale& scale, double tolerance_m, Density density);

/// As preference(), for the colours.
double color_preference(const PreparedPass& a, const PreparedPass& b, const Pose& one,
                        const Pose& other, const ColorScale& scale, double tolerance_m);

}  // namespace turnscan::passes
