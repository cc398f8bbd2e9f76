#pragma once
// Kernels: inner loops on plain arrays that are compiled once per instruction set and give bitwise
// identical results. A kernel K is a struct of function pointers; NAME.hpp declares it, NAME.inl
// defines its body, turnscan_kernels() in cmake/ compiles that for each instruction set, and
// NAME.cpp instantiates KernelChoice<K> (kernel_dispatch.hpp).
//
// Bodies include this and their NAME.hpp: they must not use inline functions with external linkage.
// The linker would keep one copy, which may need an instruction set that the machine lacks.

#include <turnscan/core/simd/instruction_set.hpp>

namespace turnscan {

/// Defined at the end of the body, for TURNSCAN_INSTRUCTION_SET.
template <class Kernel, InstructionSet kSet>
const Kernel& built_kernel();

/// The variants of a kernel. All functions are thread-safe.
template <class Kernel>
class KernelChoice {
 public:
  /// nullptr if it was not built or this machine lacks it; never for kPortable.
  static const Kernel* find(InstructionSet set);
  /// The widest variant that this machine supports, or the one set by use().
  static const Kernel& current();
  /// For tests and benchmarks: all later calls of current() return this variant. Throws
  /// std::invalid_argument if find() returns nullptr.
  static void use(InstructionSet set);

 private:
  struct State;
  static State& state();
};

}  // namespace turnscan
