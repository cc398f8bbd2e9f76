#include <cmath>
#include <turnscan/reconstruction/outliers_kernel.hpp>

namespace turnscan::outliers {
namespace {

using Float4 = float __attribute__((vector_size(16)));

struct Lanes {
  static constexpr int kCount = 4;
  Float4 v;

  static Lanes set(float value) { return {Float4{value, value, value, value}}; }
  static Lanes load(const float* p) {
    Lanes r;
    __builtin_memcpy(&r.v, p, sizeof r.v);
    return r;
  }
  void store(float* p) const { __builtin_memcpy(p, &v, sizeof v); }
  /// Sum of the roots in double and ascending, rounded once: as PCL does.
  static void store_mean(const Lanes* best, int k, float* mean) {
    double sum[kCount] = {};
    for (int i = 0; i < k; ++i)
      for (int lane = 0; lane < kCount; ++lane) sum[lane] += std::sqrt(double(best[i].v[lane]));
    for (int lane = 0; lane < kCount; ++lane) mean[lane] = static_cast<float>(sum[lane] / k);
  }
};

inline Lanes operator+(Lanes a, Lanes b) { return {a.v + b.v}; }
inline Lanes operator-(Lanes a, Lanes b) { return {a.v - b.v}; }
inline Lanes operator*(Lanes a, Lanes b) { return {a.v * b.v}; }
inline Lanes min(Lanes a, Lanes b) { return {a.v < b.v ? a.v : b.v}; }
inline Lanes max(Lanes a, Lanes b) { return {a.v > b.v ? a.v : b.v}; }
inline Lanes absolute(Lanes a) { return max(a, {-a.v}); }
template <class Bits>
inline unsigned bits(Bits m) {
  return (m[0] & 1u) | (m[1] & 2u) | (m[2] & 4u) | (m[3] & 8u);
}
inline unsigned less(Lanes a, Lanes b) { return bits(a.v < b.v); }
inline unsigned less_equal(Lanes a, Lanes b) { return bits(a.v <= b.v); }

#include <turnscan/reconstruction/outliers_search.hpp>
// Needs the one above.
#include <turnscan/reconstruction/outliers_tree_search.hpp>

}  // namespace

extern const Kernel kPortableKernel;
const Kernel kPortableKernel = kKernel;

}  // namespace turnscan::outliers
