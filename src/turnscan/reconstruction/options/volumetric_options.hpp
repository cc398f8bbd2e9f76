#pragma once

#include <optional>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// Options of the volumetric method.
struct VolumetricOptions {
  std::optional<double> truncation_m;  ///< along the rays, around each sample
  bool fit = true;                     ///< move the vertices onto the frames' measurements
  std::optional<double> fit_reach_m;
  int fit_iterations = 3;
  bool sharpen = true;         ///< compensate the sensor's filter
  bool mark_invented = false;  ///< paint surface that no frame measured
};
OptionTable describe(VolumetricOptions& options);

}  // namespace turnscan
