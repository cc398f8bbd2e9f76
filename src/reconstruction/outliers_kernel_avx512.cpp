#include <immintrin.h>

#include <turnscan/reconstruction/outliers_kernel.hpp>

namespace turnscan::outliers {
namespace {

struct Lanes {
  static constexpr int kCount = 16;
  __m512 v;

  static Lanes set(float value) { return {_mm512_set1_ps(value)}; }
  static Lanes load(const float* p) { return {_mm512_loadu_ps(p)}; }
  void store(float* p) const { _mm512_storeu_ps(p, v); }
  /// Sum of the roots in double and ascending, rounded once: as PCL does.
  static void store_mean(const Lanes* best, int k, float* mean) {
    for (int half = 0; half < 2; ++half) {
      __m512d sum = _mm512_setzero_pd();
      for (int i = 0; i < k; ++i) {
        const __m256 eight =
            half == 0 ? _mm512_castps512_ps256(best[i].v) : _mm512_extractf32x8_ps(best[i].v, 1);
        sum = _mm512_add_pd(sum, _mm512_sqrt_pd(_mm512_cvtps_pd(eight)));
      }
      _mm256_storeu_ps(mean + 8 * half, _mm512_cvtpd_ps(_mm512_div_pd(sum, _mm512_set1_pd(k))));
    }
  }
};

inline Lanes operator+(Lanes a, Lanes b) { return {_mm512_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm512_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm512_mul_ps(a.v, b.v)}; }
inline Lanes min(Lanes a, Lanes b) { return {_mm512_min_ps(a.v, b.v)}; }
inline Lanes max(Lanes a, Lanes b) { return {_mm512_max_ps(a.v, b.v)}; }
inline Lanes absolute(Lanes a) { return {_mm512_abs_ps(a.v)}; }
inline unsigned less(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ); }
inline unsigned less_equal(Lanes a, Lanes b) { return _mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ); }

#include <turnscan/reconstruction/outliers_search.hpp>
// Needs the one above.
#include <turnscan/reconstruction/outliers_tree_search.hpp>

}  // namespace

extern const Kernel kAvx512Kernel;
const Kernel kAvx512Kernel = kKernel;

}  // namespace turnscan::outliers
