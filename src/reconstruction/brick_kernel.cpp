#include <turnscan/core/kernel_choice.hpp>
#include <turnscan/reconstruction/brick_kernel.hpp>

namespace turnscan::bricks {

extern const Kernel kPortableKernel, kAvx2Kernel, kAvx512Kernel;

namespace {

KernelChoice<Kernel>& choice() {
  static KernelChoice<Kernel> kernels(TURNSCAN_KERNELS);
  return kernels;
}

}  // namespace

const Kernel* kernel_for(InstructionSet set) { return choice().find(set); }
const Kernel& kernel() { return choice().current(); }
void use_instruction_set(InstructionSet set) { choice().use(set); }

}  // namespace turnscan::bricks
