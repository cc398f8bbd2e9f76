#pragma once
// The convex hull of points.

#include <array>
#include <cstdint>
#include <span>
#include <turnscan/core/pose.hpp>
#include <vector>

namespace turnscan {

/// Triangles as indices into `points`, counter-clockwise seen from outside. Points nearer to the
/// hull of the others than 1e-6 of the extent may be omitted, and the triangulation of flat faces
/// is arbitrary. Empty if there are fewer than four points, one is not finite, or they are
/// coplanar. Quickhull (Barber, Dobkin and Huhdanpaa 1996). Deterministic.
std::vector<std::array<std::uint32_t, 3>> convex_hull(std::span<const Vec3f> points);

}  // namespace turnscan
