#include <turnscan/simulator/noise_kernel.hpp>

namespace turnscan::noise {

extern const Kernel kPortableKernel;
#ifdef TURNSCAN_NOISE_X86
extern const Kernel kAvx2Kernel;
extern const Kernel kAvx512Kernel;
#endif

const Kernel* kernel_for(InstructionSet set) {
  if (set == InstructionSet::kPortable) return &kPortableKernel;
#ifdef TURNSCAN_NOISE_X86
  if (set == InstructionSet::kAvx2 && __builtin_cpu_supports("avx2")) return &kAvx2Kernel;
  if (set == InstructionSet::kAvx512 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512vl"))
    return &kAvx512Kernel;
#endif
  return nullptr;
}

const Kernel& kernel() {
  static const Kernel* const widest = [] {
    if (const Kernel* found = kernel_for(InstructionSet::kAvx512)) return found;
    if (const Kernel* found = kernel_for(InstructionSet::kAvx2)) return found;
    return &kPortableKernel;
  }();
  return *widest;
}

}  // namespace turnscan::noise
