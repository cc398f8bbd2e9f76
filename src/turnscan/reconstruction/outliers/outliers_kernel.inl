// Body of the kernel (core/simd/kernel_choice.hpp).

#include <turnscan/reconstruction/outliers/outliers_kernel.hpp>

namespace turnscan::outliers {
namespace {

constexpr int kLanes = TURNSCAN_NATIVE_LANES;
#include <turnscan/core/simd/lanes.inl>

/// Half of the lanes, in double.
using D = double __attribute__((vector_size(4 * kLanes)));
using HalfF = float __attribute__((vector_size(2 * kLanes)));

/// Square roots of the first (0) or the last (1) half.
inline D roots_of_half(F v, int half) {
#if TURNSCAN_NATIVE_LANES == 16
  const __m256 eight = half == 0 ? _mm512_castps512_ps256(v) : _mm512_extractf32x8_ps(v, 1);
  return _mm512_sqrt_pd(_mm512_cvtps_pd(eight));
#elif TURNSCAN_NATIVE_LANES == 8
  const __m128 four = half == 0 ? _mm256_castps256_ps128(v) : _mm256_extractf128_ps(v, 1);
  return _mm256_sqrt_pd(_mm256_cvtps_pd(four));
#else
  return D{__builtin_sqrt(double(v[2 * half])), __builtin_sqrt(double(v[2 * half + 1]))};
#endif
}

/// Sum of the roots in double and ascending, rounded once: as PCL does.
inline void store_mean(const F* best, int k, float* mean) {
  for (int half = 0; half < 2; ++half) {
    D sum{};
    for (int i = 0; i < k; ++i) sum += roots_of_half(best[i], half);
    sum /= double(k);
    store(mean + half * kLanes / 2, __builtin_convertvector(sum, HalfF));
  }
}

#include <turnscan/reconstruction/outliers/outliers_search.inl>
// Needs the one above.
#include <turnscan/reconstruction/outliers/outliers_tree_search.inl>

constexpr OutlierKernel kKernel{search_row, search_leaf};

}  // namespace
}  // namespace turnscan::outliers

template <>
const turnscan::outliers::OutlierKernel&
turnscan::built_kernel<turnscan::outliers::OutlierKernel, TURNSCAN_INSTRUCTION_SET>() {
  return outliers::kKernel;
}
