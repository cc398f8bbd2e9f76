#include <turnscan/reconstruction/refine_kernel.hpp>

namespace turnscan::refinement {
namespace {

#include <turnscan/reconstruction/refine_moments.hpp>

}  // namespace

extern const Kernel kAvx2Kernel;
const Kernel kAvx2Kernel{add_moments};

}  // namespace turnscan::refinement
