#pragma once
// The zero set of values on a regular grid as a closed mesh.

#include <cstdint>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/geometry/grid/grid_index.hpp>
#include <vector>

namespace turnscan {

/// Values at the samples origin_m + cell_m * (i, j, k), 0 <= i < size[0] and so on, stored in
/// bricks of 8^3 samples. A brick that was not allocated has one value throughout and costs eight
/// bytes.
class BrickGrid {
 public:
  static constexpr int kBrick = kBrickSide;
  static constexpr std::size_t kBrickSamples = turnscan::kBrickSamples;

  /// An empty grid.
  BrickGrid() = default;
  /// A grid in which everything has `value`. Fails with kInvalidOption for sizes outside [1, 2^20]
  /// or a cell that is not positive, and with kResourceLimit if the table of bricks alone needs
  /// over max_bytes.
  static Result<BrickGrid> create(const Vec3d& origin_m, double cell_m, GridCoords size,
                                  float value, std::size_t max_bytes);

  const GridCoords& size() const { return size_; }
  /// Bricks along each axis; the last ones may contain samples beyond size(), which are ignored.
  const GridCoords& bricks() const { return bricks_.size(); }
  double cell_m() const { return cell_m_; }
  Vec3d position(int i, int j, int k) const { return origin_m_ + cell_m_ * Vec3d(i, j, k); }

  std::size_t brick_count() const { return slot_.size(); }
  std::size_t brick_index(int bi, int bj, int bk) const { return bricks_.at({bi, bj, bk}); }
  bool has_brick(const GridCoords& b) const { return bricks_.contains(b); }
  GridCoords brick_at(std::size_t brick) const { return bricks_.coords(brick); }
  /// Position of a sample in its brick.
  static constexpr std::size_t within(int i, int j, int k) { return sample_in_brick(i, j, k); }

  float value(int i, int j, int k) const {
    const std::size_t brick = brick_index(i / kBrick, j / kBrick, k / kBrick);
    const float* own = samples(brick);
    return own != nullptr ? own[within(i, j, k)] : uniform_[brick];
  }
  /// Gives these bricks samples of their own, initialised to their uniform value. Fails with
  /// kResourceLimit if the grid would need over max_bytes.
  Result<> allocate(const std::vector<std::size_t>& bricks);
  /// The samples of an allocated brick, i fastest; nullptr for a uniform one.
  float* samples(std::size_t brick);
  const float* samples(std::size_t brick) const;
  /// The value of a brick that is not allocated.
  float& uniform(std::size_t brick) { return uniform_[brick]; }
  float uniform(std::size_t brick) const { return uniform_[brick]; }

 private:
  Vec3d origin_m_ = Vec3d::Zero();
  double cell_m_ = 1.0;
  GridCoords size_{};
  GridIndex bricks_;
  std::size_t max_bytes_ = 0;
  std::vector<std::int32_t> slot_;  // per brick: position in values_ / 512, or -1
  std::vector<float> uniform_, values_;
};

/// How a cube of the grid is polygonised.
enum class MarchingCells {
  kTetrahedra,  ///< six each (Doi and Koide 1991): a linear function's zero set
  kCubes        ///< whole (Lorensen and Cline 1987): a third of the triangles, vertices on edges of
                ///< the grid only
};

/// The surface where the values go from negative (inside) to positive (outside; zero counts as
/// positive, and so does everything beyond the grid: there the surface ends half a cell outside).
/// The result is closed, 2-manifold and outward by construction. Tetrahedra: six per cube around
/// one diagonal (Freudenthal 1942), the same in every cube, one shared vertex per edge that changes
/// sign; a linear function on a simplicial complex that is zero at none of its vertices has a
/// 2-manifold zero set. Cubes: neighbours agree on the face that they share, and no triangle's edge
/// is used by two of them (cube_table.hpp). Vertices lie where the values say, linearly. Fails with
/// kFormat for values that are not finite, kResourceLimit above 2^30 triangles, kCancelled. An
/// empty mesh if nothing is negative. The same bytes for any number of threads.
Result<TriangleMesh> isosurface(const BrickGrid& grid, MarchingCells cells,
                                const RunContext& context);

}  // namespace turnscan
