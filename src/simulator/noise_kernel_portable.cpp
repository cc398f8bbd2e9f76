#include <turnscan/simulator/noise_kernel.hpp>

namespace turnscan::noise {
namespace {
#include <turnscan/simulator/noise_loops.hpp>
}  // namespace

extern const Kernel kPortableKernel;
const Kernel kPortableKernel = kKernelTable;

}  // namespace turnscan::noise
