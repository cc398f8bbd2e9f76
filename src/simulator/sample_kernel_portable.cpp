#include <turnscan/simulator/sample_kernel.hpp>

namespace turnscan::sampling {
namespace {

#include <turnscan/simulator/sample_packet.hpp>
// Needs the one above.
#include <turnscan/simulator/sample_occlusion.hpp>

}  // namespace

extern const Kernel kPortableKernel;
const Kernel kPortableKernel{trace_image, trace_list};

}  // namespace turnscan::sampling
