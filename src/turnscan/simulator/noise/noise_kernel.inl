// Body of the kernel (core/simd/kernel_choice.hpp).

#include <turnscan/simulator/noise/noise_kernel.hpp>

namespace turnscan::noise {
namespace {

#include <turnscan/simulator/noise/noise_functions.inl>

void normals(Key key, std::uint32_t first, std::uint32_t step, int n, float* __restrict out) {
  for (int i = 0; i < n; ++i)
    out[i] = normal_pair(key, first + static_cast<std::uint32_t>(i) * step).cosine;
}

// Needs the functions above.
#include <turnscan/simulator/noise/noise_kinect_v2.inl>

constexpr NoiseKernel kKernel = {&normals, &phasors, &correlate, &combine,
                                 &smooth,  &unwrap,  &depth,     &edges};

}  // namespace
}  // namespace turnscan::noise

template <>
const turnscan::noise::NoiseKernel&
turnscan::built_kernel<turnscan::noise::NoiseKernel, TURNSCAN_INSTRUCTION_SET>() {
  return noise::kKernel;
}
