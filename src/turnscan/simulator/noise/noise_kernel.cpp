#include <turnscan/core/simd/kernel_dispatch.hpp>
#include <turnscan/simulator/noise/noise_kernel.hpp>

template class turnscan::KernelChoice<turnscan::noise::NoiseKernel>;
