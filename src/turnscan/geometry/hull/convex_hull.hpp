#pragma once
// The convex hull of points.

#include <array>
#include <cstdint>
#include <span>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan {

/// Triangles between positions in `points`, counter-clockwise seen from outside. Points that are
/// nearer to the hull of the others than 1e-6 of the extent may be left out, and what is flat is
/// cut into triangles somehow. Empty when there are fewer than four points, one is not finite, or
/// they lie in a plane. Quickhull (Barber, Dobkin and Huhdanpaa 1996). Deterministic.
std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vec3f> points);

}  // namespace turnscan
