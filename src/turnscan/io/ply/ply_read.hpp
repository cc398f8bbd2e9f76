#pragma once
// A PLY file as arrays: the common part of the readers of meshes and of clouds.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/result.hpp>
#include <vector>

namespace turnscan::ply {

enum class PlyParts { kFaces, kGrid };

struct PlyContent {
  PointCloud cloud;  ///< all vertices of the file, including non-finite ones
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices are in range
  int grid_width = 0;
  int grid_height = 0;
  std::vector<std::int32_t> grid;  ///< -1 or in range
  std::optional<Viewpoint> viewpoint;
  std::string name;
  std::size_t end = 0;  ///< position after the last element
};

/// Reads the vertices and the requested other parts.
Result<PlyContent> parse_ply(std::string_view bytes, PlyParts parts);

}  // namespace turnscan::ply
