#pragma once
// A surface cut into charts: connected parts that are seen as a whole from one direction.

#include <array>
#include <cstdint>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::texture {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

/// Per triangle and side (corner k to corner k + 1) the triangle beyond it; kNoTriangle at a border
/// and where more than two meet.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const TriangleMesh& mesh);

/// Unit normals; zero of a triangle without area.
std::vector<Vec3f> face_normals(const TriangleMesh& mesh);

/// A triangle's normal is turned from its chart's axis by no more than the angle of this cosine:
/// drawn along the axis, it is stretched by no more than 1 / 0.35.
inline constexpr float kMinChartCosine = 0.35f;

struct Charts {
  std::vector<std::uint32_t> of;  ///< per triangle
  std::vector<Vec3f> axis;        ///< per chart, unit
};

/// Charts by the direction of the surface: each triangle takes the nearest of 14 directions (the
/// faces and corners of a cube), neighbours pull it to theirs; small charts join those beside them.
/// In the order of their first triangles. The same for any number of threads.
Charts find_charts(const TriangleMesh& mesh,
                   const std::vector<std::array<std::uint32_t, 3>>& neighbours);

/// The triangles listed leave their charts and make new ones, connected among themselves and within
/// the angle of an axis of their own.
void split_off(const TriangleMesh& mesh,
               const std::vector<std::array<std::uint32_t, 3>>& neighbours,
               const std::vector<std::uint32_t>& triangles, Charts& charts);

}  // namespace turnscan::texture
