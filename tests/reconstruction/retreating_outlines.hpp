#pragma once
// A sensor that matches patterns: where it sees a surface at a grazing angle, it shows what lies
// beside it.

#include <tests/reconstruction/turning_scan.hpp>

namespace turnscan::testing {

/// A box with flat sides, 70 x 80 x 30 mm.
double carton(const Vec3d& o, const Vec3d& d);

/// In every third frame the outlines lie so many pixels within what was seen: there the frame shows
/// the depth beside them. Of frames with a platter.
MemorySequence with_retreating_outlines(MemorySequence sequence, int pixels);

}  // namespace turnscan::testing
