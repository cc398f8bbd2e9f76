#include <turnscan/core/simd/kernel_dispatch.hpp>
#include <turnscan/reconstruction/points/refine_kernel.hpp>

template class turnscan::KernelChoice<turnscan::refinement::RefineKernel>;
