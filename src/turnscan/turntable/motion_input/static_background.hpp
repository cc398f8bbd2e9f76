#pragma once
// Static background behind a moving object, continued from where it is visible.

#include <cstdint>
#include <vector>

namespace turnscan::motion {

/// Image of the static background; sizes in pixels, depths in metres, 0: none.
struct StaticBackground {
  int width = 0, height = 0;
  std::vector<float> seen;       ///< where nothing moves
  std::vector<float> candidate;  ///< where something moves: a possible static surface behind it
  std::vector<float> tolerance;  ///< of a candidate, for its noise
  double least_patch = 0.5;  ///< minimum size of a patch of `seen`, as a share of all candidates
};

/// Per pixel, 1 where the candidate continues the surface that is seen beside it: it is within its
/// tolerance of the plane through the surrounding surface. The farthest depth of an object that
/// always occludes a pixel is a candidate, too, and continues nothing. Only large patches of `seen`
/// count, since the axis of a turning object appears static.
std::vector<std::uint8_t> continued_from_seen(const StaticBackground& depths);

}  // namespace turnscan::motion
