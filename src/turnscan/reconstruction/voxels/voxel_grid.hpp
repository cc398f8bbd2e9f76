#pragma once
// Point counts in cubic voxels, and the filter on these counts (thesis 3.4.2).

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan::voxels {

using VoxelIndex = Eigen::Vector3i;

/// The occupied voxels of a cloud, ordered by (z, y, x). Voxel i covers index * size to (index + 1)
/// * size on each axis from the grid's origin, which is that of the points' frame unless stated.
class VoxelGrid {
 public:
  struct Voxel {
    VoxelIndex index;
    std::uint32_t begin;  ///< its points are order()[begin, end), in ascending order
    std::uint32_t end;
    std::uint32_t points;  ///< number of points counted
    std::uint32_t count() const { return points; }
  };

  /// Sorts points into voxels in O(n). Fails with kInvalidOption if a side would take more than
  /// 2^21 voxels, with kTooFewPoints if there are no points, kCancelled. points must outlive the
  /// grid.
  static Result<VoxelGrid> build(const std::vector<Vec3f>& points, double size_m,
                                 const RunContext& context);

  /// A grid of voxels that were counted elsewhere, ordered by (z, y, x); begin and end are kept,
  /// order() is empty. Fails as build does.
  static Result<VoxelGrid> of_counted(std::vector<Voxel> voxels, double size_m,
                                      const Vec3d& origin_m = Vec3d::Zero());

  double size_m() const { return size_m_; }
  const std::vector<Voxel>& voxels() const { return voxels_; }
  const std::vector<std::uint32_t>& order() const { return order_; }
  Vec3d center(const Voxel& voxel) const {
    return (voxel.index.cast<double>() + Vec3d::Constant(0.5)) * size_m_ + origin_m_;
  }
  /// The voxel that contains a place, occupied or not.
  VoxelIndex index_of(const Vec3d& p) const {
    return ((p - origin_m_) / size_m_).array().floor().cast<int>();
  }
  /// Position in voxels() or -1.
  std::int64_t find(const VoxelIndex& index) const;
  /// Calls visit(position) for each occupied voxel that intersects the box [low, high], ordered by
  /// (z, y, x). `visit` gets positions in voxels().
  template <class Visit>
  void for_each_in_box(const VoxelIndex& low, const VoxelIndex& high, const Visit& visit) const;

  /// Drops the voxels for which keep[i] is 0; order() keeps its entries.
  void filter(const std::vector<std::uint8_t>& keep);

 private:
  std::uint64_t key(const VoxelIndex& index) const;
  void index_rows();

  double size_m_ = 0.0;
  Vec3d origin_m_ = Vec3d::Zero();
  VoxelIndex low_ = VoxelIndex::Zero();
  VoxelIndex extent_ = VoxelIndex::Zero();
  std::vector<Voxel> voxels_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> row_begin_;  ///< first voxel of each (z, y) row; one more at the end
};

template <class Visit>
void VoxelGrid::for_each_in_box(const VoxelIndex& low, const VoxelIndex& high,
                                const Visit& visit) const {
  const VoxelIndex a = (low - low_).cwiseMax(0);
  const VoxelIndex b = (high - low_).cwiseMin(extent_ - VoxelIndex::Ones());
  for (int z = a.z(); z <= b.z(); ++z) {
    for (int y = a.y(); y <= b.y(); ++y) {
      const std::size_t row = std::size_t(z) * std::size_t(extent_.y()) + std::size_t(y);
      for (std::uint32_t i = row_begin_[row]; i < row_begin_[row + 1]; ++i) {
        const int x = voxels_[i].index.x();
        if (x > high.x()) break;
        if (x >= low.x()) visit(i);
      }
    }
  }
}

/// Result of the automatic threshold.
struct ThresholdChoice {
  int min_points = 1;
  double typical_count = 0.0;  ///< count of the voxel that contains the median point
};

/// M from the counts themselves: a tenth of the typical count, at least 1. A tenth keeps surfaces
/// that were seen at an incidence angle of 70 degrees in a third of the frames, and drops flying
/// pixels, whose counts are hundreds of times below the surface's in a dense scan.
ThresholdChoice choose_min_points(const VoxelGrid& grid);

/// 1 for voxels with at least min_points points.
std::vector<std::uint8_t> count_filter(const VoxelGrid& grid, int min_points);

}  // namespace turnscan::voxels
