#pragma once
// Members of KernelChoice, for the source that instantiates it; not for bodies of kernels.

#include <array>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <turnscan/core/simd/kernel_choice.hpp>

namespace turnscan {

template <class Kernel>
struct KernelChoice<Kernel>::State {
  /// Indexed by InstructionSet; null if it was not built.
  std::array<const Kernel*, 3> built{
      &built_kernel<Kernel, InstructionSet::kPortable>(),
#ifdef __x86_64__
      &built_kernel<Kernel, InstructionSet::kAvx2>(),
      &built_kernel<Kernel, InstructionSet::kAvx512>(),
#endif
  };
  std::atomic<const Kernel*> current = built[0];

  State() {
    for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512})
      if (const Kernel* found = find(set)) current = found;
  }
  const Kernel* find(InstructionSet set) const {
    return machine_has(set) ? built[static_cast<std::size_t>(set)] : nullptr;
  }
};

template <class Kernel>
typename KernelChoice<Kernel>::State& KernelChoice<Kernel>::state() {
  static State state;
  return state;
}

template <class Kernel>
const Kernel* KernelChoice<Kernel>::find(InstructionSet set) {
  return state().find(set);
}

template <class Kernel>
const Kernel& KernelChoice<Kernel>::current() {
  return *state().current.load(std::memory_order_relaxed);
}

template <class Kernel>
void KernelChoice<Kernel>::use(InstructionSet set) {
  const Kernel* found = find(set);
  if (!found) throw std::invalid_argument("KernelChoice::use: this machine lacks it");
  state().current.store(found, std::memory_order_relaxed);
}

}  // namespace turnscan
