#pragma once
// Measurements summed in cells: the input of the stages after the merge.

#include <array>
#include <turnscan/core/image.hpp>
#include <turnscan/reconstruction/voxels/voxel_grid.hpp>

namespace turnscan::voxels {

/// The sub-voxels of a voxel that most rays crossed, all with the same count (sub-voxel counting).
struct Peak {
  std::uint32_t begin = 0, end = 0;  ///< of MeasuredCells::peak_points
};

/// The measurements of a scan by cells, table frame. The cells of a voxel are consecutive, and
/// voxels are in the order of the grid.
struct MeasuredCells {
  /// This many more values can be read from each column behind the last cell.
  static constexpr std::size_t kPadding = 16;

  /// Per cell: the mean of its points (x, y, z), the mean of the unit vectors to the sensors that
  /// saw them (x, y, z; not normalised), and their number.
  std::array<std::vector<float>, 7> columns;
  std::vector<Rgb> colors;  ///< means; empty without colour
  VoxelGrid grid;           ///< all occupied voxels; voxel's begin and end are cells
  std::vector<Peak> peaks;  ///< per voxel of the grid; empty if sub-voxels were not counted
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
