#include <immintrin.h>

#include <turnscan/reconstruction/outliers_kernel.hpp>

namespace turnscan::outliers {
namespace {

struct Lanes {
  static constexpr int kCount = 8;
  __m256 v;

  static Lanes set(float value) { return {_mm256_set1_ps(value)}; }
  static Lanes load(const float* p) { return {_mm256_loadu_ps(p)}; }
  void store(float* p) const { _mm256_storeu_ps(p, v); }
  /// Sum of the roots in double and ascending, rounded once: as PCL does.
  static void store_mean(const Lanes* best, int k, float* mean) {
    for (int half = 0; half < 2; ++half) {
      __m256d sum = _mm256_setzero_pd();
      for (int i = 0; i < k; ++i) {
        const __m128 four =
            half == 0 ? _mm256_castps256_ps128(best[i].v) : _mm256_extractf128_ps(best[i].v, 1);
        sum = _mm256_add_pd(sum, _mm256_sqrt_pd(_mm256_cvtps_pd(four)));
      }
      _mm_storeu_ps(mean + 4 * half, _mm256_cvtpd_ps(_mm256_div_pd(sum, _mm256_set1_pd(k))));
    }
  }
};

inline Lanes operator+(Lanes a, Lanes b) { return {_mm256_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm256_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm256_mul_ps(a.v, b.v)}; }
inline Lanes min(Lanes a, Lanes b) { return {_mm256_min_ps(a.v, b.v)}; }
inline Lanes max(Lanes a, Lanes b) { return {_mm256_max_ps(a.v, b.v)}; }
inline Lanes absolute(Lanes a) { return {_mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v)}; }
inline unsigned less(Lanes a, Lanes b) {
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)));
}
inline unsigned less_equal(Lanes a, Lanes b) {
  return unsigned(_mm256_movemask_ps(_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)));
}

#include <turnscan/reconstruction/outliers_search.hpp>
// Needs the one above.
#include <turnscan/reconstruction/outliers_tree_search.hpp>

}  // namespace

extern const Kernel kAvx2Kernel;
const Kernel kAvx2Kernel = kKernel;

}  // namespace turnscan::outliers
