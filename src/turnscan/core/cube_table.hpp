#pragma once
// Triangulation of a surface within a cube whose corners are inside or outside.
// Corner c is at (c & 1, c >> 1 & 1, c >> 2).

#include <array>
#include <cstdint>
#include <span>

namespace turnscan {

inline constexpr int kCubeEdges = 12;

struct CubeEdge {
  int corner;  ///< the end at which the coordinate `axis` is 0
  int axis;    ///< 0, 1, 2
};

CubeEdge cube_edge(int edge);

/// The edges on which the triangle's corners are.
using CubeTriangle = std::array<std::uint8_t, 3>;

/// Triangles for the corners whose bit in `inside` is set; counter-clockwise seen from outside.
std::span<const CubeTriangle> cube_triangles(unsigned inside);

}  // namespace turnscan
