#pragma once
// The inner loop of refine: weighted moments of measurements over a tangent plane. Plain arrays, so
// that it can be compiled for several instruction sets.

#include <array>
#include <cstddef>

namespace turnscan::detail {

/// Measurements, structure of arrays: positions in metres and unit vectors to their sensors.
struct Measurements {
  const float* x;
  const float* y;
  const float* z;
  const float* view_x;
  const float* view_y;
  const float* view_z;
};

/// Tangent frame at a site and the reach of the weights.
struct TangentFrame {
  float p[3], n[3], u[3], v[3];
  float inverse_reach;   ///< 1 / tangential reach
  float inverse_height;  ///< 1 / reach of the robust weight along the normal
  float facing;          ///< least cosine between normal and view
};

/// Sums of w x^i y^j for i + j <= 4 and of w h x^i y^j for i + j <= 2, with x, y in units of the
/// tangential reach and h in metres. Weight: (1 - x^2 - y^2)^3 * (1 - (h / height)^2)^2, both
/// cut at zero (Tukey's biweight along the normal), for measurements whose sensor faces the site.
inline constexpr std::size_t kMoments = 21;
inline constexpr std::size_t kLanes = 8;
using MomentLanes = std::array<std::array<float, kLanes>, kMoments>;

/// Order of the sums: 1 x y xx xy yy xxx xxy xyy yyy x4 xxxy xxyy xyyy y4, then h hx hy hxx hxy
/// hyy. Adds measurements [begin, end). Lane k takes those at begin + k, begin + k + 8, ...: the
/// same bytes for every instruction set.
void add_moments(const Measurements& m, std::size_t begin, std::size_t end,
                 const TangentFrame& frame, MomentLanes& sums);

}  // namespace turnscan::detail
