#pragma once
// The zero set of values on a regular grid as a closed mesh.

#include <array>
#include <cstdint>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan {

/// Values at the samples origin_m + cell_m * (i, j, k), 0 <= i < size[0] and so on, kept in bricks
/// of 8^3 samples. A brick that nobody touched has one value throughout and costs four bytes.
class BrickGrid {
 public:
  static constexpr int kBrick = 8;
  /// An empty grid.
  BrickGrid() = default;
  /// Everything has `value`. Fails with kInvalidOption for sizes outside [1, 2^20] or a cell that
  /// is not positive, and kResourceLimit when the table of bricks alone needs over max_bytes.
  static Result<BrickGrid> create(const Vec3d& origin_m, double cell_m, std::array<int, 3> size,
                                  float value, std::size_t max_bytes);

  const std::array<int, 3>& size() const { return size_; }
  const std::array<int, 3>& bricks() const { return bricks_; }
  double cell_m() const { return cell_m_; }
  Vec3d position(int i, int j, int k) const { return origin_m_ + cell_m_ * Vec3d(i, j, k); }

  float value(int i, int j, int k) const {
    const std::int32_t slot = table_[brick_index(i / kBrick, j / kBrick, k / kBrick)];
    return slot < 0 ? uniform_[std::size_t(-1 - slot)]
                    : values_[std::size_t(slot) * kBrickSamples + within(i, j, k)];
  }
  /// Gives brick (bi, bj, bk) values of its own (its uniform value at first) and returns its 512
  /// samples, i fastest; the pointer lasts until the next call. Fails with kResourceLimit when all
  /// bricks would need over max_bytes. Not from several threads.
  Result<float*> touch(int bi, int bj, int bk);
  /// The 512 samples of a touched brick, nullptr for a uniform one.
  float* samples(int bi, int bj, int bk);
  const float* samples(int bi, int bj, int bk) const;
  /// Makes a brick uniform; memory of a touched one is not given back.
  void set_uniform(int bi, int bj, int bk, float value);
  /// The value of a uniform brick.
  float uniform(int bi, int bj, int bk) const;

  static constexpr std::size_t within(int i, int j, int k) {
    return std::size_t(i % kBrick) +
           kBrick * (std::size_t(j % kBrick) + kBrick * std::size_t(k % kBrick));
  }

 private:
  static constexpr std::size_t kBrickSamples = kBrick * kBrick * kBrick;
  std::size_t brick_index(int bi, int bj, int bk) const {
    return std::size_t(bi) +
           std::size_t(bricks_[0]) * (std::size_t(bj) + std::size_t(bricks_[1]) * std::size_t(bk));
  }
  Vec3d origin_m_ = Vec3d::Zero();
  double cell_m_ = 1.0;
  std::array<int, 3> size_{}, bricks_{};
  std::size_t max_bytes_ = 0;
  std::vector<std::int32_t> table_;  // >= 0: slot in values_; < 0: -1 - position in uniform_
  std::vector<float> values_, uniform_;
};

struct IsosurfaceOptions {
  /// A vertex keeps at least this fraction of its grid edge's length from the edge's ends, so that
  /// triangles do not shrink to nothing. 0 <= snap < 0.5; the topology does not depend on it.
  double snap = 0.02;
};

/// The surface where the values go from negative (inside) to positive (outside; zero counts as
/// positive, and so does everything beyond the grid, one cell away). Marching tetrahedra: six
/// tetrahedra a cube around one diagonal (Freudenthal 1942), the same in every cube, one shared
/// vertex per grid edge that changes sign. A linear function on a simplicial complex with no zero
/// at a vertex has a 2-manifold zero set: the result is closed, 2-manifold and outward by
/// construction. NaN fails with kFormat, more than 2^31 triangles with kResourceLimit; empty mesh
/// if there is nothing inside. The same bytes for any number of threads.
Result<TriangleMesh> isosurface(const BrickGrid& grid, const IsosurfaceOptions& options,
                                const RunContext& context);

/// The same for values of all samples, i fastest, then j, then k.
struct DenseGrid {
  Vec3d origin_m = Vec3d::Zero();
  double cell_m = 1.0;
  std::array<int, 3> size{};
  std::vector<float> values;
};
Result<TriangleMesh> isosurface(const DenseGrid& grid, const IsosurfaceOptions& options,
                                const RunContext& context);

}  // namespace turnscan
