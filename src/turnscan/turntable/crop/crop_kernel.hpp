#pragma once
// Which pixels of a depth image lie in an interval of their own: the inner loop of the live crop, a
// kernel (core/simd/kernel_choice.hpp).

#include <cstddef>
#include <cstdint>
#include <turnscan/core/simd/kernel_choice.hpp>

namespace turnscan::crop_kernel {

struct CropKernel {
  /// Bit j of bits[i] says whether pixel 64 i + j is kept: first <= raw < first + count, without
  /// overflow. n pixels, in whole words: the arrays reach to a multiple of 64, their count there
  /// is 0 or their bits do not matter.
  void (*select)(const std::uint16_t* raw, const std::uint16_t* first, const std::uint16_t* count,
                 std::size_t n, std::uint64_t* bits);
};
using CropKernels = KernelChoice<CropKernel>;

}  // namespace turnscan::crop_kernel
