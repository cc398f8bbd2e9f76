#include <turnscan/core/kernel_choice.hpp>
#include <turnscan/turntable/crop_kernel.hpp>

namespace turnscan::crop_kernel {

extern const Kernel kPortableKernel, kAvx2Kernel, kAvx512Kernel;

namespace {

const KernelChoice<Kernel>& choice() {
  static const KernelChoice<Kernel> kernels(TURNSCAN_KERNELS);
  return kernels;
}

}  // namespace

const Kernel* kernel_for(InstructionSet set) { return choice().find(set); }
const Kernel& kernel() { return choice().current(); }

}  // namespace turnscan::crop_kernel
