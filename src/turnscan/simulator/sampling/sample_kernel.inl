// Body of the kernel (core/simd/kernel_choice.hpp).

#include <turnscan/simulator/sampling/sample_kernel.hpp>

namespace turnscan::sampling {
namespace {

#include <turnscan/core/simd/lanes.inl>
#include <turnscan/simulator/sampling/sample_packet.inl>
// Each needs those above.
#include <turnscan/simulator/sampling/sample_occlusion.inl>
#include <turnscan/simulator/sampling/sample_raster.inl>
// Needs the one above.
#include <turnscan/simulator/sampling/sample_draw.inl>

constexpr SampleKernel kKernel{trace_image, trace_list, draw_image};

}  // namespace
}  // namespace turnscan::sampling

template <>
const turnscan::sampling::SampleKernel&
turnscan::built_kernel<turnscan::sampling::SampleKernel, TURNSCAN_INSTRUCTION_SET>() {
  return sampling::kKernel;
}
