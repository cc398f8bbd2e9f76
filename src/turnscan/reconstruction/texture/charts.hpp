#pragma once
// Divides a surface into charts: connected parts that are entirely visible from one direction.

#include <array>
#include <cstdint>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::texture {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// Per triangle and side (corner k to corner k + 1) the adjacent triangle; kNoTriangle at a border
/// and where more than two meet.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const TriangleMesh& mesh);

/// Unit normals; zero for a triangle without area.
std::vector<Vec3f> face_normals(const TriangleMesh& mesh);

/// Minimum cosine between a triangle's normal and its chart's axis: projected along the axis, the
/// triangle is stretched by no more than 1 / 0.35.
inline constexpr float kMinChartCosine = 0.35f;

struct Charts {
  std::vector<std::uint32_t> of;  ///< per triangle
  std::vector<Vec3f> axis;        ///< per chart, unit
};

/// Charts by the direction of the surface: each triangle takes the nearest of 14 directions (the
/// faces and corners of a cube), with smoothing over its neighbours; small charts are merged with
/// adjacent ones. In the order of their first triangles. The result does not depend on the number
/// of threads.
Charts find_charts(const TriangleMesh& mesh,
                   const std::vector<std::array<std::uint32_t, 3>>& neighbours);

/// Moves the listed triangles from their charts into new ones, which are connected and whose
/// normals are within the maximum angle of an axis of their own.
void split_off(const TriangleMesh& mesh,
               const std::vector<std::array<std::uint32_t, 3>>& neighbours,
               const std::vector<std::uint32_t>& triangles, Charts& charts);

}  // namespace turnscan::texture
