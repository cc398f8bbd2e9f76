#pragma once
// Which pixels of a depth image lie in an interval of their own: the inner loop of the live crop,
// on plain arrays, built once per instruction set. Not installed.
// The sources that include this are compiled for other instruction sets: nothing here may bring in
// inline functions that the linker could merge with those of other sources.

#include <cstddef>
#include <cstdint>
#include <turnscan/core/instruction_set.hpp>

namespace turnscan::crop_kernel {

struct Kernel {
  /// Bit j of bits[i] says whether pixel 64 i + j is kept: first <= raw < first + count, without
  /// overflow. n pixels, in whole words: the arrays reach to a multiple of 64, their count there
  /// is 0 or their bits do not matter.
  void (*select)(const std::uint16_t* raw, const std::uint16_t* first, const std::uint16_t* count,
                 std::size_t n, std::uint64_t* bits);
};

using turnscan::InstructionSet;

/// nullptr when it was not built or this machine lacks it.
const Kernel* kernel_for(InstructionSet set);
/// The widest that this machine has.
const Kernel& kernel();

}  // namespace turnscan::crop_kernel
