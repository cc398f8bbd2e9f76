#pragma once
// Triangulation of the area that planar outlines enclose.

#include <optional>
#include <span>
#include <turnscan/core/eigen.hpp>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <vector>

namespace turnscan::mesh {

/// A closed outline: indices of points, each joined to the next and the last to the first.
using Outline = std::vector<std::uint32_t>;

/// The constrained Delaunay triangulation of the area enclosed by the outlines with the even-odd
/// rule (GEOS). Its triangles use only the outlines' points, are clockwise, and contain each edge
/// of an outline once, in the direction opposite to that of an outline with its inside to the left.
/// nullopt if outlines touch or cross.
std::optional<std::vector<Triangle>> triangulate_outlines(std::span<const Eigen::Vector2d> points,
                                                          std::span<const Outline> outlines);

}  // namespace turnscan::mesh
