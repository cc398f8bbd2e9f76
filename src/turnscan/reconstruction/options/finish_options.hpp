#pragma once

#include <optional>
#include <turnscan/core/option_table.hpp>

namespace turnscan {

enum class Holes { kSmooth, kFlat, kOpen };

/// What a person wants of the finished meshes, whatever the method.
struct FinishOptions {
  Holes holes = Holes::kSmooth;  ///< what becomes of surface that nothing measured
  double hole_size_m = 0.005;    ///< longest side; smaller ones are closed smoothly in any case
  double smooth_m = 0.0;         ///< half of the height of waves of this length stays; 0: off
  double smallest_part_m = 0.0;  ///< parts whose longest side is shorter are dropped
  std::optional<int> object;     ///< the only one that is kept, counted from 1 by size
};
OptionTable describe(FinishOptions& options);

}  // namespace turnscan
