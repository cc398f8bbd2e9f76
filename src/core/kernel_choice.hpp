#pragma once
// The kernel of a family that fits this machine. Not for sources built for an instruction set.

#include <array>
#include <atomic>
#include <stdexcept>
#include <turnscan/core/instruction_set.hpp>

/// What a family passes on to KernelChoice: of kPortableKernel, kAvx2Kernel and kAvx512Kernel those
/// that are built for this machine (turnscan_kernels in cmake/).
#ifdef TURNSCAN_X86_KERNELS
#define TURNSCAN_KERNELS kPortableKernel, &kAvx2Kernel, &kAvx512Kernel
#else
#define TURNSCAN_KERNELS kPortableKernel, nullptr, nullptr
#endif

namespace turnscan {

/// Kernels that give the same bytes, one per instruction set; null where one was not built. All
/// calls may come from several threads.
template <class Kernel>
class KernelChoice {
 public:
  KernelChoice(const Kernel& portable, const Kernel* avx2, const Kernel* avx512)
      : built_{&portable, avx2, avx512}, current_(&portable) {
    for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512})
      if (const Kernel* found = find(set)) current_ = found;
  }

  /// nullptr when it was not built or this machine lacks it.
  const Kernel* find(InstructionSet set) const {
    return machine_has(set) ? built_[static_cast<std::size_t>(set)] : nullptr;
  }
  /// The widest that this machine has, or the one set by use().
  const Kernel& current() const { return *current_.load(std::memory_order_relaxed); }
  /// For tests and benchmarks: all later calls use this one. Throws std::invalid_argument when
  /// find() has none.
  void use(InstructionSet set) {
    const Kernel* found = find(set);
    if (!found) throw std::invalid_argument("use_instruction_set: this machine lacks it");
    current_.store(found, std::memory_order_relaxed);
  }

 private:
  std::array<const Kernel*, 3> built_;
  std::atomic<const Kernel*> current_;
};

}  // namespace turnscan
