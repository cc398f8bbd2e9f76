#include <turnscan/core/simd/kernel_dispatch.hpp>
#include <turnscan/reconstruction/outliers/outliers_kernel.hpp>

template class turnscan::KernelChoice<turnscan::outliers::OutlierKernel>;
