#pragma once
// Writes binary little-endian PLY.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/image.hpp>
#include <turnscan/core/pose.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/atomic_file.hpp>

namespace turnscan::ply {

/// Attributes are empty or as long as points; faces and grid are written unless they are empty.
struct PlyJob {
  std::span<const Vec3f> points;
  std::span<const Vec3f> normals;
  std::span<const Rgb> colors;
  std::span<const float> weights;
  std::span<const float> confidence;
  std::span<const std::uint32_t> frame;
  std::span<const std::array<std::uint32_t, 3>> triangles;
  int grid_width = 0;
  int grid_height = 0;
  std::span<const std::int32_t> grid;
  std::optional<Viewpoint> viewpoint;
  std::string_view name;
  std::string frame_mark;  ///< see file::mark_of()
};

Result<> write_ply(FileSink& sink, const PlyJob& job);

}  // namespace turnscan::ply
