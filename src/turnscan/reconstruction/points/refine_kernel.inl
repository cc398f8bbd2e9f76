// Body of the kernel (core/simd/kernel_choice.hpp).

#include <turnscan/reconstruction/points/refine_kernel.hpp>

namespace turnscan::refinement {
namespace {

#include <turnscan/core/simd/lanes.inl>

inline F cut(const F& v) { return v > 0.0f ? v : F{}; }

/// The lanes' sums, held in registers over a range of measurements.
struct Sums {
  F sum[kMoments];

  explicit Sums(const MomentLanes& from) {
    for (std::size_t i = 0; i < kMoments; ++i) sum[i] = load(from.sum[i]);
  }
  void store(MomentLanes& to) const {
    for (std::size_t i = 0; i < kMoments; ++i) __builtin_memcpy(to.sum[i], &sum[i], sizeof sum[i]);
  }
  void add(const F& w, const F& x, const F& y, const F& h) {
    const F wx = w * x, wy = w * y, wxx = wx * x, wxy = wx * y, wyy = wy * y;
    sum[0] += w, sum[1] += wx, sum[2] += wy, sum[3] += wxx, sum[4] += wxy, sum[5] += wyy;
    const F wxxx = wxx * x, wxxy = wxx * y, wxyy = wyy * x, wyyy = wyy * y;
    sum[6] += wxxx, sum[7] += wxxy, sum[8] += wxyy, sum[9] += wyyy;
    sum[10] += wxxx * x, sum[11] += wxxx * y, sum[12] += wxxy * y, sum[13] += wyyy * x;
    sum[14] += wyyy * y;
    sum[15] += w * h, sum[16] += wx * h, sum[17] += wy * h;
    sum[18] += wxx * h, sum[19] += wxy * h, sum[20] += wyy * h;
  }
};

void add_moments(const Measurements& m, std::size_t begin, std::size_t end, const TangentFrame& f,
                 MomentLanes& moments) {
  Sums sums(moments);
  for (std::size_t i = begin; i < end; i += kLanes) {
    const F dx = load(m.x + i) - f.p[0], dy = load(m.y + i) - f.p[1], dz = load(m.z + i) - f.p[2];
    const F h = dx * f.n[0] + dy * f.n[1] + dz * f.n[2];
    const F x = (dx * f.u[0] + dy * f.u[1] + dz * f.u[2]) * f.inverse_reach;
    const F y = (dx * f.v[0] + dy * f.v[1] + dz * f.v[2]) * f.inverse_reach;
    const F s = h * f.inverse_height;
    const F a = cut(1.0f - x * x - y * y), b = cut(1.0f - s * s);
    const F cosine =
        load(m.view_x + i) * f.n[0] + load(m.view_y + i) * f.n[1] + load(m.view_z + i) * f.n[2];
    const F w = a * a * a * b * b * load(m.count + i);
    const I counts = (cosine > all(f.facing)) & (counting() < all(int(end - i)));
    // What does not count may be anything: its weight is zero, and so must be its terms.
    sums.add(counts ? w : F{}, counts ? x : F{}, counts ? y : F{}, counts ? h : F{});
  }
  sums.store(moments);
}

constexpr RefineKernel kKernel{add_moments};

}  // namespace
}  // namespace turnscan::refinement

template <>
const turnscan::refinement::RefineKernel&
turnscan::built_kernel<turnscan::refinement::RefineKernel, TURNSCAN_INSTRUCTION_SET>() {
  return refinement::kKernel;
}
