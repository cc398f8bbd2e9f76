#pragma once
// The samples of the Poisson solver: their positions in its cube, areas, depths in the octree, and
// contributions to a level.

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/reconstruction/poisson/poisson_bricks.hpp>

namespace turnscan::poisson {

/// The coarsest level: one brick.
inline constexpr int kCoarsest = 3;

struct Cube {
  Vec3d corner = Vec3d::Zero();
  double side_m = 1.0;
};

/// A point in a brick: its cell, and the weights of the B-splines of the previous, this and the
/// next cell there along each axis.
struct SplineFootprint {
  std::array<std::int8_t, 3> cell;
  std::array<std::array<float, 3>, 3> weight;
};

/// Calls body(cell, weight) for the 27 cells whose B-splines reach a point.
template <class Body>
void for_each_cell(const SplineFootprint& spot, const Neighbours& bricks, const Body& body) {
  std::size_t slot[3][3], cell[3][3];  // along each axis: contribution to the index among the
                                       // neighbours
  for (std::size_t a = 0; a < 3; ++a) {
    constexpr std::size_t kSlots[3] = {1, 3, 9}, kSteps[3] = {1, 8, 64};
    for (int n = 0; n < 3; ++n) {
      const int at = spot.cell[a] + n - 1;
      slot[a][n] = std::size_t((at >> 3) + 1) * kSlots[a];
      cell[a][n] = std::size_t(at & 7) * kSteps[a];
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      const float row = spot.weight[1][j] * spot.weight[2][k];
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t brick = bricks[slot[0][i] + slot[1][j] + slot[2][k]];
        if (brick < 0) continue;
        body(std::size_t(brick) * kCells + (cell[0][i] + cell[1][j] + cell[2][k]),
             spot.weight[0][i] * row);
      }
    }
  }
}

/// The samples of a cell, which a level treats as one.
struct SampleCluster {
  SplineFootprint spot;
  float area;  ///< in units of a cell's face
};

/// Consecutive elements of one brick: [begin, end).
struct BrickRun {
  std::uint32_t begin, end;
  Index brick;
};
/// Indexed by color_of(brick).
using ColoredRuns = std::array<std::vector<BrickRun>, 8>;

struct SampleClusters {
  std::vector<SampleCluster> all;
  ColoredRuns runs;
};

class OrientedSamples {
 public:
  /// Points and normals, sorted along a Morton curve. wanted: samples per face of a cell that a
  /// level must have. max_depth in [kCoarsest, 20].
  OrientedSamples(const PointCloud& oriented, const Cube& cube, int max_depth, double wanted);

  std::size_t size() const { return position_.size(); }
  /// The deepest level for which a fair share of the samples is dense enough.
  int deepest() const { return deepest_; }

  /// Calls body(cell) once for each cell with samples that belong to level `depth` or deeper.
  template <class Body>
  void for_each_occupied(int depth, const Body& body) const {
    const int shift = 3 * (max_depth_ - depth);
    for (std::size_t i = 0; i < size();) {
      bool used = false;
      const std::size_t first = i;
      for (; i < size() && code_[i] >> shift == code_[first] >> shift; ++i)
        used |= depth_.empty() || depth_[i] > float(depth - 1);
      if (used) body(cell(first, depth));
    }
  }

  /// Adds the normals that belong to this level, each times its area, to the coefficients around
  /// it: the vector field that the indicator's gradient is to follow, in units of 1 / cell.
  void splat(const SparseBricks& bricks, Field& x, Field& y, Field& z) const;
  /// The samples of each cell of the existing bricks as one: mean position, total area.
  SampleClusters clusters(const SparseBricks& bricks) const;
  /// Median of a function at the samples; bricks: those around all of them.
  float median(const SparseBricks& bricks, const Field& function) const;

 private:
  Index cell(std::size_t sample, int depth) const;
  SplineFootprint spot(std::size_t sample, const Vec3d& position, int depth) const;
  ColoredRuns runs(int depth) const;
  /// Calls body(sample, bricks around its brick), those of one colour on all threads.
  template <class Body>
  void for_each_sample(const SparseBricks& bricks, const Body& body) const;
  int density_depth() const;
  std::vector<float> read(const SparseBricks& bricks, const Field& function) const;
  void choose_depths(double wanted);

  int max_depth_, deepest_ = 0;
  std::vector<Vec3d> position_;  // in units of the cube's side
  std::vector<Vec3f> normal_;
  std::vector<std::uint64_t> code_;  // of the cell at max_depth
  std::vector<double> area_;         // in units of the cube's face
  std::vector<float> depth_;
};

}  // namespace turnscan::poisson
