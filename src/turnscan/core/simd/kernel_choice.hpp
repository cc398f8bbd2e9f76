#pragma once
// Kernels: inner loops on plain arrays that are built once per instruction set and give the same
// bytes for each. A kernel K is a struct of pointers to functions; NAME.hpp declares it, NAME.inl
// is its body, turnscan_kernels() in cmake/ compiles that for each instruction set, and NAME.cpp
// instantiates KernelChoice<K> (kernel_dispatch.hpp).
//
// Bodies include this and their NAME.hpp: nothing in them may bring in inline functions with
// external linkage. The linker would keep one copy, which may need an instruction set that the
// machine lacks.

#include <turnscan/core/simd/instruction_set.hpp>

namespace turnscan {

/// Defined at the end of the body, for TURNSCAN_INSTRUCTION_SET.
template <class Kernel, InstructionSet kSet>
const Kernel& built_kernel();

/// The variants of a kernel. All calls may come from several threads.
template <class Kernel>
class KernelChoice {
 public:
  /// nullptr when it was not built or this machine lacks it; never for kPortable.
  static const Kernel* find(InstructionSet set);
  /// The widest that this machine has, or the one set by use().
  static const Kernel& current();
  /// For tests and benchmarks: all later calls of current() return this one. Throws
  /// std::invalid_argument when find() has none.
  static void use(InstructionSet set);

 private:
  struct State;
  static State& state();
};

}  // namespace turnscan
