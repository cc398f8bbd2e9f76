#include <initializer_list>
#include <turnscan/turntable/crop_kernel.hpp>

namespace turnscan::crop_kernel {

extern const Kernel kPortableKernel;
#ifdef TURNSCAN_CROP_X86
extern const Kernel kAvx2Kernel;
extern const Kernel kAvx512Kernel;
#endif

const Kernel* kernel_for(InstructionSet set) {
  if (set == InstructionSet::kPortable) return &kPortableKernel;
#ifdef TURNSCAN_CROP_X86
  if (set == InstructionSet::kAvx2 && __builtin_cpu_supports("avx2")) return &kAvx2Kernel;
  if (set == InstructionSet::kAvx512 && __builtin_cpu_supports("avx512f") &&
      __builtin_cpu_supports("avx512bw"))
    return &kAvx512Kernel;
#endif
  return nullptr;
}

const Kernel& kernel() {
  static const Kernel* const widest = [] {
    for (const InstructionSet set : {InstructionSet::kAvx512, InstructionSet::kAvx2})
      if (const Kernel* found = kernel_for(set)) return found;
    return &kPortableKernel;
  }();
  return *widest;
}

}  // namespace turnscan::crop_kernel
