#pragma once
// Edges of a mesh that pass through its triangles.

#include <cstdint>
#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// The edges that pass from one side of a triangle to the other through it or its border, where the
/// edge has no vertex of the triangle. Where the surface of a mesh crosses itself, there are some.
/// Edges that end at a triangle do not count, nor do triangles that lie in one plane.
struct SelfIntersections {
  std::size_t edges = 0;
  /// Per triangle, 1 if such an edge belongs to it or passes through it.
  std::vector<std::uint8_t> triangles;
};

/// moved: if not empty, one flag per triangle; pairs of triangles without it are not asked. Of each
/// triangle, at most 1,000 others near it are asked, and 100 in a mesh of more than 300,000, so
/// that the time grows with the number of triangles, about 2 us each; where more meet, some are
/// missed. Once the context is cancelled nothing more is found. Triangles with an index out of
/// range or a vertex that is not finite are ignored.
SelfIntersections self_intersections(const TriangleMesh& mesh,
                                     std::span<const std::uint8_t> moved = {},
                                     const RunContext& context = RunContext());

}  // namespace turnscan
