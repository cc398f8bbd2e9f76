#include <turnscan/reconstruction/brick_kernel.hpp>

namespace turnscan::bricks {
namespace {

constexpr int kLanes = 4;
using F = float __attribute__((vector_size(4 * kLanes)));
using I = int __attribute__((vector_size(4 * kLanes)));

inline F smaller(const F& a, const F& b) { return a < b ? a : b; }
inline F larger(const F& a, const F& b) { return a > b ? a : b; }
inline I gather(const std::uint32_t* from, const I& at) {
  I out;
  for (int k = 0; k < kLanes; ++k) out[k] = static_cast<int>(from[at[k]]);
  return out;
}
/// One bit a lane.
inline unsigned bits(const I& mask) {
  unsigned out = 0;
  for (int k = 0; k < kLanes; ++k) out |= (mask[k] != 0 ? 1u : 0u) << k;
  return out;
}

#include <turnscan/reconstruction/brick_loops.hpp>

}  // namespace

extern const Kernel kPortableKernel;
const Kernel kPortableKernel = kLoops;

}  // namespace turnscan::bricks
