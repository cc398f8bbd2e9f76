#pragma once

#include <optional>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// Of the volumetric method.
struct VolumetricOptions {
  std::optional<double> truncation_m;  ///< along the rays, around each sample
  bool fit = true;                     ///< move the vertices onto the frames' measurements
  std::optional<double> fit_reach_m;
  int fit_iterations = 3;
  bool sharpen = true;         ///< take back what the sensor's filter did
  bool mark_invented = false;  ///< paint what no frame measured
};
OptionTable describe(VolumetricOptions& options);

}  // namespace turnscan
