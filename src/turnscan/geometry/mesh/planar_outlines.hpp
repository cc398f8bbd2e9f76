#pragma once
// Triangles over the area that outlines in a plane enclose.

#include <Eigen/Core>
#include <optional>
#include <span>
#include <turnscan/geometry/mesh/edge_table.hpp>
#include <vector>

namespace turnscan::mesh {

/// A closed outline: numbers of points, each joined to the next and the last to the first.
using Outline = std::vector<std::uint32_t>;

/// The constrained Delaunay triangulation of what the outlines enclose, an even number of them
/// being outside (GEOS). Its triangles use the outlines' points and no others, turn clockwise, and
/// have each edge of an outline once, in the other direction than the outline where that has its
/// inside to the left. Empty optional: outlines touch or cross.
std::optional<std::vector<Triangle>> triangulate_outlines(std::span<const Eigen::Vector2d> points,
                                                          std::span<const Outline> outlines);

}  // namespace turnscan::mesh
