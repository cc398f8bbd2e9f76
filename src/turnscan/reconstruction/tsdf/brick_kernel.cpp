#include <turnscan/core/simd/kernel_dispatch.hpp>
#include <turnscan/reconstruction/tsdf/brick_kernel.hpp>

template class turnscan::KernelChoice<turnscan::tsdf::BrickKernel>;
