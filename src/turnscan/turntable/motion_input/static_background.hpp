#pragma once
// What stands still behind an object that moves, continued from where nothing hides it.

#include <cstdint>
#include <vector>

namespace turnscan::motion {

/// An image of what stands still, pixel by pixel; sizes in pixels, depths in metres, 0: none.
struct StaticBackground {
  int width = 0, height = 0;
  std::vector<float> seen;       ///< where nothing moves
  std::vector<float> candidate;  ///< where something moves: what may stand still behind it
  std::vector<float> tolerance;  ///< of a candidate: what its noise may make of it
  double least_patch = 0.5;      ///< of `seen` that counts, as a share of all candidates
};

/// Per pixel, 1 where the candidate continues the surface that is seen beside it: it lies within
/// its tolerance of the plane through what is known around. The farthest depth of an object that
/// hides a pixel always is a candidate, too, and continues nothing. Only large patches of `seen`
/// count, for the axis of an object that turns seems to stand still.
std::vector<std::uint8_t> continued_from_seen(const StaticBackground& depths);

}  // namespace turnscan::motion
