#include <immintrin.h>

#include <turnscan/reconstruction/brick_kernel.hpp>

namespace turnscan::bricks {
namespace {

constexpr int kLanes = 16;
using F = float __attribute__((vector_size(4 * kLanes)));
using I = int __attribute__((vector_size(4 * kLanes)));

inline F smaller(const F& a, const F& b) { return _mm512_min_ps(a, b); }
inline F larger(const F& a, const F& b) { return _mm512_max_ps(a, b); }
inline I gather(const std::uint32_t* from, const I& at) {
  return reinterpret_cast<I>(_mm512_i32gather_epi32(reinterpret_cast<__m512i>(at), from, 4));
}
/// One bit a lane.
inline unsigned bits(const I& mask) {
  return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask));
}

#include <turnscan/reconstruction/brick_loops.hpp>

}  // namespace

extern const Kernel kAvx512Kernel;
const Kernel kAvx512Kernel = kLoops;

}  // namespace turnscan::bricks
