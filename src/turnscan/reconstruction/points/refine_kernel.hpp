#pragma once
// The inner loop of refine: weighted moments of measurements over a tangent plane. A kernel
// (core/simd/kernel_choice.hpp).

#include <cstddef>
#include <turnscan/core/simd/kernel_choice.hpp>

namespace turnscan::refinement {

/// Measurements, structure of arrays: positions in metres, vectors to their sensors (mean of unit
/// vectors), and their multiplicities.
struct Measurements {
  const float* x;
  const float* y;
  const float* z;
  const float* view_x;
  const float* view_y;
  const float* view_z;
  const float* count;
};

/// Tangent frame at a site and the reach of the weights.
struct TangentFrame {
  float p[3], n[3], u[3], v[3];
  float inverse_reach;   ///< 1 / tangential reach
  float inverse_height;  ///< 1 / reach of the robust weight along the normal
  float facing;          ///< smallest cosine between normal and view
};

/// Sums of w x^i y^j for i + j <= 4 and of w h x^i y^j for i + j <= 2, with x, y in units of the
/// tangential reach and h in metres. Weight: (1 - x^2 - y^2)^3 * (1 - (h / height)^2)^2, both
/// cut at zero (Tukey's biweight along the normal), for measurements whose sensor faces the site.
inline constexpr std::size_t kMoments = 21;
inline constexpr std::size_t kLanes = 16;
/// Zeroed before the first call. The sums of a site are those of all lanes.
struct alignas(64) MomentLanes {
  float sum[kMoments][kLanes];
};

struct RefineKernel {
  /// Order of the sums: 1 x y xx xy yy xxx xxy xyy yyy x4 xxxy xxyy xyyy y4, then h hx hy hxx hxy
  /// hyy. Adds measurements [begin, end). Lane k takes those at begin + k, begin + k + kLanes, ...,
  /// so that the result is byte-identical for every instruction set. kLanes - 1 measurements behind
  /// `end` must be readable.
  void (*add_moments)(const Measurements& m, std::size_t begin, std::size_t end,
                      const TangentFrame& frame, MomentLanes& sums);
};
using RefineKernels = KernelChoice<RefineKernel>;

}  // namespace turnscan::refinement
