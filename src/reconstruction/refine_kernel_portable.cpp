#include <turnscan/reconstruction/refine_kernel.hpp>

namespace turnscan::refinement {
namespace {

#include <turnscan/reconstruction/refine_moments.hpp>

}  // namespace

extern const Kernel kPortableKernel;
const Kernel kPortableKernel{add_moments};

}  // namespace turnscan::refinement
