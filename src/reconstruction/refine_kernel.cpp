#include <algorithm>
#include <turnscan/reconstruction/refine_kernel.hpp>

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define TURNSCAN_CLONES __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define TURNSCAN_CLONES
#endif

namespace turnscan::detail {

TURNSCAN_CLONES
void add_moments(const Measurements& m, std::size_t begin, std::size_t end, const TangentFrame& f,
                 MomentLanes& sums) {
  for (std::size_t base = begin; base < end; base += kLanes) {
    // The last, short round reads its last measurement again in the idle lanes, with weight zero.
    float qx[kLanes], qy[kLanes], qz[kLanes], ax[kLanes], ay[kLanes], az[kLanes], on[kLanes];
    const std::size_t left = std::min(kLanes, end - base);
    if (left == kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const std::size_t i = base + k;
        qx[k] = m.x[i], qy[k] = m.y[i], qz[k] = m.z[i];
        ax[k] = m.view_x[i], ay[k] = m.view_y[i], az[k] = m.view_z[i];
        on[k] = 1.0f;
      }
    } else {
      for (std::size_t k = 0; k < kLanes; ++k) {
        const std::size_t i = std::min(base + k, end - 1);
        qx[k] = m.x[i], qy[k] = m.y[i], qz[k] = m.z[i];
        ax[k] = m.view_x[i], ay[k] = m.view_y[i], az[k] = m.view_z[i];
        on[k] = k < left ? 1.0f : 0.0f;
      }
    }
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float dx = qx[k] - f.p[0], dy = qy[k] - f.p[1], dz = qz[k] - f.p[2];
      const float h = dx * f.n[0] + dy * f.n[1] + dz * f.n[2];
      const float x = (dx * f.u[0] + dy * f.u[1] + dz * f.u[2]) * f.inverse_reach;
      const float y = (dx * f.v[0] + dy * f.v[1] + dz * f.v[2]) * f.inverse_reach;
      const float xx = x * x, xy = x * y, yy = y * y;
      const float s = h * f.inverse_height;
      const float a = std::max(0.0f, 1.0f - xx - yy), b = std::max(0.0f, 1.0f - s * s);
      const float cosine = ax[k] * f.n[0] + ay[k] * f.n[1] + az[k] * f.n[2];
      const float w = (cosine > f.facing ? on[k] : 0.0f) * a * a * a * b * b;
      const float wx = w * x, wy = w * y, wxx = w * xx, wxy = w * xy, wyy = w * yy;
      const float wh = w * h;
      sums[0][k] += w, sums[1][k] += wx, sums[2][k] += wy;
      sums[3][k] += wxx, sums[4][k] += wxy, sums[5][k] += wyy;
      sums[6][k] += wxx * x, sums[7][k] += wxx * y, sums[8][k] += wyy * x, sums[9][k] += wyy * y;
      sums[10][k] += wxx * xx, sums[11][k] += wxx * xy, sums[12][k] += wxx * yy;
      sums[13][k] += wyy * xy, sums[14][k] += wyy * yy;
      sums[15][k] += wh, sums[16][k] += wh * x, sums[17][k] += wh * y;
      sums[18][k] += wh * xx, sums[19][k] += wh * xy, sums[20][k] += wh * yy;
    }
  }
}

}  // namespace turnscan::detail
