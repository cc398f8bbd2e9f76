#include <turnscan/reconstruction/refine_kernel.hpp>

namespace turnscan::refinement {
namespace {

#include <turnscan/reconstruction/refine_moments.hpp>

}  // namespace

extern const Kernel kAvx512Kernel;
const Kernel kAvx512Kernel{add_moments};

}  // namespace turnscan::refinement
