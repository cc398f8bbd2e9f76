// Body of the kernel (core/simd/kernel_choice.hpp).

#include <turnscan/reconstruction/tsdf/brick_kernel.hpp>

namespace turnscan::tsdf {
namespace {

constexpr int kLanes = TURNSCAN_NATIVE_LANES;
#include <turnscan/core/simd/lanes.inl>
// Needs the one above.
#include <turnscan/reconstruction/tsdf/brick_loops.inl>

constexpr BrickKernel kKernel{group_visibility, part_visibility, integrate, compute_bounds};

}  // namespace
}  // namespace turnscan::tsdf

template <>
const turnscan::tsdf::BrickKernel&
turnscan::built_kernel<turnscan::tsdf::BrickKernel, TURNSCAN_INSTRUCTION_SET>() {
  return tsdf::kKernel;
}
