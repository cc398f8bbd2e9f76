#include <immintrin.h>

#include <turnscan/reconstruction/brick_kernel.hpp>

namespace turnscan::bricks {
namespace {

constexpr int kLanes = 8;
using F = float __attribute__((vector_size(4 * kLanes)));
using I = int __attribute__((vector_size(4 * kLanes)));

inline F smaller(const F& a, const F& b) { return _mm256_min_ps(a, b); }
inline F larger(const F& a, const F& b) { return _mm256_max_ps(a, b); }
inline I gather(const std::uint32_t* from, const I& at) {
  return reinterpret_cast<I>(
      _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), reinterpret_cast<__m256i>(at), 4));
}
/// One bit a lane.
inline unsigned bits(const I& mask) {
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
}

#include <turnscan/reconstruction/brick_loops.hpp>

}  // namespace

extern const Kernel kAvx2Kernel;
const Kernel kAvx2Kernel = kLoops;

}  // namespace turnscan::bricks
