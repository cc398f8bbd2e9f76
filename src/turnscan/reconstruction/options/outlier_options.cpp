#include <turnscan/reconstruction/options/outlier_options.hpp>

namespace turnscan {

OptionTable describe(OutlierOptions& o) {
  OptionTable table;
  table.flag("outliers", o.enabled, "Drop points of a frame whose neighbours are far")
      .number("outlier-k", o.neighbours, {1, 1000},
              "Neighbours whose mean distance is compared with the frame's")
      .number("outlier-lambda", o.lambda, Quantity::kNone, {0.0, 100.0},
              "Standard deviations above the frame's mean distance that are still kept");
  return table;
}

}  // namespace turnscan
