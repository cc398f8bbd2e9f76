#pragma once
// Brown-Conrady lens distortion: D. C. Brown, "Close-range camera calibration", Photogrammetric
// Engineering 37 (1971), with OpenCV's names; and its rational form, in which the radial factor is
// a fraction of two polynomials (D. Claus and A. Fitzgibbon, "A rational function lens distortion
// model for general cameras", CVPR 2005; OpenCV's CALIB_RATIONAL_MODEL, "Calib3d" manual). The one
// definition, for doubles, floats and vectors of floats. Sources built for other instruction sets
// include this: the functions are always inlined, so that the linker has nothing to merge.

#include <cstdint>

namespace turnscan {

/// Radial (k1, k2, k3) and tangential (p1, p2) coefficients, and those of the denominator (k4, k5,
/// k6), all zero in Brown's model.
template <class Scalar>
struct BrownConrady {
  Scalar k1, k2, p1, p2, k3;
  Scalar k4 = 0, k5 = 0, k6 = 0;
  /// Of the rational form: from this squared distance from the axis (at z = 1) on, the radial
  /// factor stays what it is there. Image points then never fold back into the image.
  Scalar largest_r2 = 1e30f;

  bool rational() const { return k4 != Scalar(0) || k5 != Scalar(0) || k6 != Scalar(0); }
};

/// The same lens with numbers of another precision.
template <class To, class From>
BrownConrady<To> lens_as(const BrownConrady<From>& from) {
  return {To(from.k1), To(from.k2), To(from.p1), To(from.p2),        To(from.k3),
          To(from.k4), To(from.k5), To(from.k6), To(from.largest_r2)};
}

/// How 2 p x y is multiplied: ((2 p) x) y or (2 p) (x y). They differ in the last bit; each caller
/// stays with one, so that results stay the same bytes.
enum class TangentialProduct : std::uint8_t { kLeftToRight, kShared };

/// Distorts the image point (x, y) at z = 1, whose squared distance from the axis is r2, with a
/// radial factor that is known.
template <TangentialProduct kProduct, class Scalar, class Value>
__attribute__((always_inline)) inline void distort_by(const BrownConrady<Scalar>& lens,
                                                      const Value& r2, const Value& radial,
                                                      Value& x, Value& y) {
  constexpr Scalar kTwo = 2;
  Value along_x, along_y;
  if constexpr (kProduct == TangentialProduct::kShared) {
    const Value xy = x * y;
    along_x = kTwo * lens.p1 * xy;
    along_y = kTwo * lens.p2 * xy;
  } else {
    along_x = kTwo * lens.p1 * x * y;
    along_y = kTwo * lens.p2 * x * y;
  }
  const Value distorted_x = x * radial + along_x + lens.p2 * (r2 + kTwo * x * x);
  y = y * radial + lens.p1 * (r2 + kTwo * y * y) + along_y;
  x = distorted_x;
}

/// Distorts the image point (x, y) at z = 1 by Brown's model: k4 to k6 are not looked at.
template <TangentialProduct kProduct = TangentialProduct::kLeftToRight, class Scalar, class Value>
__attribute__((always_inline)) inline void distort(const BrownConrady<Scalar>& lens, Value& x,
                                                   Value& y) {
  constexpr Scalar kOne = 1;
  const Value r2 = x * x + y * y;
  const Value radial = kOne + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  distort_by<kProduct>(lens, r2, radial, x, y);
}

/// The same with the denominator.
template <TangentialProduct kProduct = TangentialProduct::kLeftToRight, class Scalar, class Value>
__attribute__((always_inline)) inline void distort_rational(const BrownConrady<Scalar>& lens,
                                                            Value& x, Value& y) {
  constexpr Scalar kOne = 1;
  const Value r2 = x * x + y * y;
  const Value most = Value{} + lens.largest_r2;
  const Value s = r2 < most ? r2 : most;
  const Value radial = (kOne + s * (lens.k1 + s * (lens.k2 + s * lens.k3))) /
                       (kOne + s * (lens.k4 + s * (lens.k5 + s * lens.k6)));
  distort_by<kProduct>(lens, r2, radial, x, y);
}

/// Whichever the lens is.
template <TangentialProduct kProduct = TangentialProduct::kLeftToRight, class Scalar>
inline void distort_any(const BrownConrady<Scalar>& lens, Scalar& x, Scalar& y) {
  if (lens.rational())
    distort_rational<kProduct>(lens, x, y);
  else
    distort<kProduct>(lens, x, y);
}

}  // namespace turnscan
