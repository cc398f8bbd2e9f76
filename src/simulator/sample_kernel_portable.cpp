#include <turnscan/simulator/sample_kernel.hpp>

namespace turnscan::sampling {
namespace {

#include <turnscan/simulator/sample_packet.hpp>
// Each needs those above.
#include <turnscan/simulator/sample_occlusion.hpp>
#include <turnscan/simulator/sample_raster.hpp>

}  // namespace

extern const Kernel kPortableKernel;
const Kernel kPortableKernel{trace_image, trace_list, draw_image};

}  // namespace turnscan::sampling
