#pragma once
// What was measured, added up in cells: what the stages after the merge work on.

#include <array>
#include <turnscan/core/image.hpp>
#include <turnscan/reconstruction/voxels/voxel_grid.hpp>

namespace turnscan::voxels {

/// The places of a voxel that most rays met, all with the same count (sub-voxel counting).
struct Peak {
  std::uint32_t begin = 0, end = 0;  ///< of MeasuredCells::peak_points
};

/// MeasuredCells of a scan by cells, table frame. The cells of a voxel lie behind each other, and
/// voxels in the order of the grid.
struct MeasuredCells {
  /// Behind the last cell so many more values can be read from each column.
  static constexpr std::size_t kPadding = 16;

  /// Per cell: the mean of its points (x, y, z), the mean of the unit vectors to the sensors that
  /// saw them (x, y, z; not normalised), and their number.
  std::array<std::vector<float>, 7> columns;
  std::vector<Rgb> colors;  ///< means; empty without colour
  VoxelGrid grid;           ///< all occupied voxels; voxel's begin and end are cells
  std::vector<Peak> peaks;  ///< per voxel of the grid; empty when sub-voxels were not counted
  std::vector<Vec3f> peak_points;

  std::size_t size() const {
    return columns[6].size() < kPadding ? 0 : columns[6].size() - kPadding;
  }
  Vec3f point(std::size_t i) const { return {columns[0][i], columns[1][i], columns[2][i]}; }
  Vec3f towards_sensor(std::size_t i) const {
    return {columns[3][i], columns[4][i], columns[5][i]};
  }
  float count(std::size_t i) const { return columns[6][i]; }
};

}  // namespace turnscan::voxels
