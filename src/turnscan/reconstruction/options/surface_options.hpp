#pragma once

#include <optional>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

enum class SurfaceMethod { kPoisson, kConcaveHull, kVolumetric };

struct SurfaceOptions {
  SurfaceMethod method = SurfaceMethod::kVolumetric;
  int poisson_depth = 8;
  double samples_per_node = 1.5;
  double poisson_scale = 1.1;
  double point_weight = 10.0;     ///< refined candidates deserve more than the 4 of raw points
  std::optional<double> alpha_m;  ///< concave hull: largest radius that bridges a gap
  bool repair = true;             ///< make the mesh closed, 2-manifold and outward
};
OptionTable describe(SurfaceOptions& options);

}  // namespace turnscan
