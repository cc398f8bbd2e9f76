#pragma once
// Colour map for scalar values.

#include <turnscan/core/image.hpp>

namespace turnscan {

/// Viridis (S. van der Walt and N. Smith, 2015; CC0), interpolated linearly between ten colours: 0
/// is dark violet, 1 yellow. Fractions outside [0, 1] are clamped.
Rgb viridis(double fraction);

}  // namespace turnscan
