#include <bench/pass_motion/open3d_motion.hpp>

namespace turnscan::bench {

std::vector<OtherMotion> open3d_motions(const passes::PassSurface&, const passes::PassSurface&) {
  return {};
}

}  // namespace turnscan::bench
