#pragma once
// Point clouds on disk: PLY (read and written), PCD and text (read).

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/up_axis.hpp>
#include <vector>

namespace turnscan {

/// A cloud as stored in a file: coordinates in the file's own unit and frame.
struct CloudFile {
  PointCloud cloud;
  int grid_width = 0;  ///< columns of an organised cloud, else 0
  int grid_height = 0;
  std::vector<std::int32_t> grid;  ///< cell -> index into cloud, -1 if empty; row by row
  std::optional<Viewpoint> viewpoint;
};

/// Reads by content: PLY (ascii, binary of either byte order) or PCD (ascii, binary,
/// binary_compressed).
/// PLY: element vertex with x y z, and nx ny nz, red green blue, weight (or quality), frame if
/// present; Stanford's range_grid with obj_info num_cols and num_rows. PCD: fields x y z, normal_x
/// normal_y normal_z, rgb or rgba; HEIGHT > 1 is a grid; the position in VIEWPOINT.
/// Files named .xyz, .asc, .txt or .pts are text (xyz_read.hpp). Points that are not finite are
/// skipped, and their cells are -1. Other elements, properties and fields are ignored. Colours of
/// floating-point type are in the range 0 to 1. Fails with kFormat (damaged; a count that the
/// file's length cannot hold; an index out of range), kUnsupported (another kind of file) or as
/// read_file. A cloud without points is not an error: a scanner may see nothing.
Result<CloudFile> read_cloud(const std::filesystem::path& path);
Result<CloudFile> decode_cloud(std::string_view bytes);

/// Writes binary little-endian PLY: x y z, and nx ny nz, red green blue, float "weight", uint
/// "frame" if the cloud has them. Atomic. The second form keeps the grid (range_grid) and the
/// viewpoint (obj_info). With z up the points are rotated about x, and rotated back on reading.
/// Fails with kUnsupported unless the file's extension is .ply, or as write_file_atomically. Throws
/// std::invalid_argument if an attribute's length or a grid's size does not match.
Result<> write_cloud(const std::filesystem::path& path, const PointCloud& cloud,
                     UpAxis up = UpAxis::kFormat);
Result<> write_cloud(const std::filesystem::path& path, const CloudFile& file);

}  // namespace turnscan
