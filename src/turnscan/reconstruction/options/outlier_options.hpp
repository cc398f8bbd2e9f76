#pragma once

#include <turnscan/core/option_table.hpp>

namespace turnscan {

/// Options of the statistical outlier filter.
struct OutlierOptions {
  bool enabled = true;
  int neighbours = 10;  ///< k in [1, 1000]
  double lambda = 1.0;  ///< in [0, 100]; larger keeps more
};
OptionTable describe(OutlierOptions& options);

}  // namespace turnscan
