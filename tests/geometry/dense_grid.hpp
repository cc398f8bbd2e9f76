#pragma once
// A grid whose samples are all given, as a brick grid.

#include <limits>
#include <turnscan/geometry/grid/isosurface.hpp>
#include <vector>

namespace turnscan {

/// Values of all samples, i fastest, then j, then k.
struct DenseGrid {
  Vec3d origin_m = Vec3d::Zero();
  double cell_m = 1.0;
  GridCoords size{};
  std::vector<float> values;
};

inline Result<TriangleMesh> isosurface(const DenseGrid& dense, MarchingCells cells,
                                       const RunContext& context) {
  const auto& n = dense.size;
  TURNSCAN_ASSIGN(BrickGrid grid, BrickGrid::create(dense.origin_m, dense.cell_m, n, 0.0f,
                                                    std::numeric_limits<std::size_t>::max()));
  std::vector<std::size_t> all(grid.brick_count());
  for (std::size_t b = 0; b < all.size(); ++b) all[b] = b;
  TURNSCAN_TRY(grid.allocate(all));
  std::size_t from = 0;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i, ++from) {
        float* brick = grid.samples(
            grid.brick_index(i / BrickGrid::kBrick, j / BrickGrid::kBrick, k / BrickGrid::kBrick));
        brick[BrickGrid::within(i, j, k)] = dense.values[from];
      }
    }
  }
  return isosurface(grid, cells, context);
}

}  // namespace turnscan
