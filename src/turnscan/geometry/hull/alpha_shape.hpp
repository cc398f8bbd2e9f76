#pragma once
// The alpha shape of a set of points from their Delaunay triangulation.
// H. Edelsbrunner and E. P. Muecke, Three-dimensional alpha shapes, ACM Transactions on Graphics
// 13(1), 1994; H. Edelsbrunner, D. Kirkpatrick and R. Seidel, On the shape of a set of points in
// the plane, IEEE Transactions on Information Theory 29(4), 1983.

#include <array>
#include <cstdint>
#include <span>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Indices of four points.
using Tetrahedron = std::array<std::uint32_t, 4>;

/// The triangles of the boundary of the alpha complex: those with a tetrahedron whose circumradius
/// is at most alpha_m on exactly one side, facing away from it, and those with none on either side
/// whose own circumradius is at most alpha_m and whose smallest circumsphere contains no vertex of
/// the adjacent tetrahedra. In general not 2-manifold. The vertices are the points that are used,
/// in their order; metres.
TriangleMesh alpha_shape(std::span<const Vec3f> points, std::span<const Tetrahedron> delaunay,
                         double alpha_m);

}  // namespace turnscan
