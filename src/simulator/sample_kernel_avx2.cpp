#include <turnscan/simulator/sample_kernel.hpp>

namespace turnscan::sampling {
namespace {

#include <turnscan/simulator/sample_packet.hpp>

}  // namespace

extern const Kernel kAvx2Kernel;
const Kernel kAvx2Kernel{trace_image, trace_list};

}  // namespace turnscan::sampling
