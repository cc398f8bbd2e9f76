#include <turnscan/core/simd/kernel_dispatch.hpp>
#include <turnscan/simulator/sampling/sample_kernel.hpp>

template class turnscan::KernelChoice<turnscan::sampling::SampleKernel>;
