#include <algorithm>
#include <stdexcept>
#include <turnscan/reconstruction/method.hpp>
#include <turnscan/reconstruction/points/point_method.hpp>
#include <turnscan/reconstruction/tsdf/volumetric_method.hpp>

namespace turnscan {

Result<TriangleMesh> Method::preview(const RunContext& /*context*/) const {
  throw std::invalid_argument("Method::preview: this method has none");
}

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> entries{
      points::poisson_method(),
      points::concave_hull_method(),
      tsdf::volumetric_method(),
  };
  return entries;
}

const MethodEntry& method_entry(SurfaceMethod method) {
  const auto found = std::find_if(methods().begin(), methods().end(),
                                  [&](const MethodEntry& e) { return e.method == method; });
  if (found == methods().end()) throw std::invalid_argument("method_entry: unknown method");
  return *found;
}

}  // namespace turnscan
