#include <turnscan/core/kernel_choice.hpp>
#include <turnscan/turntable/crop_kernel.hpp>

namespace turnscan::crop_kernel {

extern const Kernel kPortableKernel, kAvx2Kernel, kAvx512Kernel;

namespace {

const KernelChoice<Kernel>& choice() {
#ifdef TURNSCAN_X86_KERNELS
  static const KernelChoice<Kernel> kernels(kPortableKernel, &kAvx2Kernel, &kAvx512Kernel);
#else
  static const KernelChoice<Kernel> kernels(kPortableKernel, nullptr, nullptr);
#endif
  return kernels;
}

}  // namespace

const Kernel* kernel_for(InstructionSet set) { return choice().find(set); }
const Kernel& kernel() { return choice().current(); }

}  // namespace turnscan::crop_kernel
