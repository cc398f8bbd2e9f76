#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

Box bounds(const std::vector<Vec3f>& points) {
  Box box;
  for (const Vec3f& p : points) box.add(p.cast<double>());
  return box;
}

}  // namespace turnscan
