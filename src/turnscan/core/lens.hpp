#pragma once
// Brown-Conrady lens distortion: D. C. Brown, "Close-range camera calibration", Photogrammetric
// Engineering 37 (1971), with OpenCV's names. The one definition, for doubles, floats and vectors
// of floats. Sources built for other instruction sets include this: the function is always inlined,
// so that the linker has nothing to merge.

#include <cstdint>

namespace turnscan {

/// Radial (k1, k2, k3) and tangential (p1, p2) coefficients.
template <class Scalar>
struct BrownConrady {
  Scalar k1, k2, p1, p2, k3;
};

/// How 2 p x y is multiplied: ((2 p) x) y or (2 p) (x y). They differ in the last bit; each caller
/// stays with one, so that results stay the same bytes.
enum class TangentialProduct : std::uint8_t { kLeftToRight, kShared };

/// Distorts the image point (x, y) at z = 1.
template <TangentialProduct kProduct = TangentialProduct::kLeftToRight, class Scalar, class Value>
__attribute__((always_inline)) inline void distort(const BrownConrady<Scalar>& lens, Value& x,
                                                   Value& y) {
  constexpr Scalar kOne = 1, kTwo = 2;
  const Value r2 = x * x + y * y;
  const Value radial = kOne + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
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

}  // namespace turnscan
