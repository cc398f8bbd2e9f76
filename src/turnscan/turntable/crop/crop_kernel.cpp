#include <turnscan/core/simd/kernel_dispatch.hpp>
#include <turnscan/turntable/crop/crop_kernel.hpp>

template class turnscan::KernelChoice<turnscan::crop_kernel::CropKernel>;
