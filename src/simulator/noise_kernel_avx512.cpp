#include <turnscan/simulator/noise_kernel.hpp>

namespace turnscan::noise {
namespace {
#include <turnscan/simulator/noise_loops.hpp>
}  // namespace

extern const Kernel kAvx512Kernel;
const Kernel kAvx512Kernel = kKernelTable;

}  // namespace turnscan::noise
