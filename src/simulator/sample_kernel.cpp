#include <turnscan/simulator/sample_kernel.hpp>

#include <atomic>
#include <stdexcept>

namespace turnscan::sampling {

extern const Kernel kPortableKernel;
#ifdef TURNSCAN_SAMPLING_X86
extern const Kernel kAvx2Kernel;
extern const Kernel kAvx512Kernel;
#endif

const Kernel* kernel_for(InstructionSet set) {
  if (set == InstructionSet::kPortable) return &kPortableKernel;
#ifdef TURNSCAN_SAMPLING_X86
  if (set == InstructionSet::kAvx2 && __builtin_cpu_supports("avx2")) return &kAvx2Kernel;
  if (set == InstructionSet::kAvx512 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return &kAvx512Kernel;
#endif
  return nullptr;
}

namespace {

const Kernel* widest() {
  for (const InstructionSet set : {InstructionSet::kAvx512, InstructionSet::kAvx2})
    if (const Kernel* found = kernel_for(set)) return found;
  return &kPortableKernel;
}

std::atomic<const Kernel*>& chosen() {
  static std::atomic<const Kernel*> kernel{widest()};
  return kernel;
}

}  // namespace

const Kernel& kernel() { return *chosen().load(std::memory_order_relaxed); }

void use_instruction_set(InstructionSet set) {
  const Kernel* found = kernel_for(set);
  if (!found) throw std::invalid_argument("use_instruction_set: this machine lacks it");
  chosen().store(found, std::memory_order_relaxed);
}

}  // namespace turnscan::sampling
