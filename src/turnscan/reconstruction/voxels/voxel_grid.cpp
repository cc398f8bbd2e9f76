#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/reconstruction/voxels/key_sort.hpp>
#include <turnscan/reconstruction/voxels/voxel_grid.hpp>

namespace turnscan::voxels {

namespace {

constexpr int kMaxSide = 1 << 21;
/// Rows (z, y) are indexed directly; more would be a cloud of a few points far apart.
constexpr std::uint64_t kMaxRows = 1ULL << 26;

/// low, high: the outermost voxels.
Result<> check_extent(const Vec3d& low, const Vec3d& high, double size_m) {
  const Vec3d sides = (high - low).array() + 1.0;
  if (sides.maxCoeff() <= kMaxSide && low.cwiseAbs().maxCoeff() < 1e9 &&
      sides.y() * sides.z() <= double(kMaxRows))
    return {};
  return fail(ErrorCode::kInvalidOption,
              "voxel-size {} is too small for a cloud of {:.3g} m; choose a larger one",
              format_quantity(size_m, Quantity::kLength), size_m * sides.maxCoeff());
}

}  // namespace

std::uint64_t VoxelGrid::key(const VoxelIndex& index) const {
  const VoxelIndex i = index - low_;
  return (std::uint64_t(i.z()) * std::uint64_t(extent_.y()) + std::uint64_t(i.y())) *
             std::uint64_t(extent_.x()) +
         std::uint64_t(i.x());
}

Result<VoxelGrid> VoxelGrid::build(const std::vector<Vec3f>& points, double size_m,
                                   const RunContext& context) {
  if (points.empty()) return fail(ErrorCode::kTooFewPoints, "voxels: there are no points to count");
  if (!(size_m > 0.0)) throw std::invalid_argument("VoxelGrid::build: size_m must be positive");
  const Box box = bounds(points);
  VoxelGrid grid;
  grid.size_m_ = size_m;
  const Vec3d low = (box.min / size_m).array().floor(), high = (box.max / size_m).array().floor();
  TURNSCAN_TRY(check_extent(low, high, size_m));
  grid.low_ = low.cast<int>();
  grid.extent_ = (high - low).cast<int>() + VoxelIndex::Ones();
  std::vector<KeyedItem> items(points.size());
  const double scale = 1.0 / size_m;
  const auto index_of = [&](std::size_t i) -> VoxelIndex {
    return (points[i].cast<double>() * scale).array().floor().cast<int>();
  };
  parallel_for(points.size(), 65536, [&](std::size_t i) {
    // Division and multiplication round differently; the clamp keeps the last bit inside.
    const VoxelIndex index =
        index_of(i).cwiseMax(grid.low_).cwiseMin(grid.low_ + grid.extent_ - VoxelIndex::Ones());
    items[i] = {grid.key(index), static_cast<std::uint32_t>(i)};
  });
  TURNSCAN_TRY(context.check());
  sort_by_key(items, grid.key(grid.low_ + grid.extent_ - VoxelIndex::Ones()));
  TURNSCAN_TRY(context.check());
  grid.order_.resize(items.size());
  const std::uint64_t nx = std::uint64_t(grid.extent_.x()), ny = std::uint64_t(grid.extent_.y());
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    grid.order_[i] = items[i].item;
    const std::uint64_t k = items[i].key;
    if (i == 0 || k != items[i - 1].key) {
      const VoxelIndex local(int(k % nx), int(k / nx % ny), int(k / nx / ny));
      grid.voxels_.push_back({grid.low_ + local, i, i, 0});
    }
    grid.voxels_.back().end = i + 1;
    ++grid.voxels_.back().points;
  }
  grid.index_rows();
  return grid;
}

Result<VoxelGrid> VoxelGrid::of_counted(std::vector<Voxel> voxels, double size_m,
                                        const Vec3d& origin_m) {
  if (voxels.empty()) return fail(ErrorCode::kTooFewPoints, "voxels: there are no points to count");
  VoxelGrid grid;
  grid.size_m_ = size_m;
  grid.origin_m_ = origin_m;
  VoxelIndex high = voxels.front().index;
  grid.low_ = high;
  for (const Voxel& voxel : voxels) {
    grid.low_ = grid.low_.cwiseMin(voxel.index);
    high = high.cwiseMax(voxel.index);
  }
  TURNSCAN_TRY(check_extent(grid.low_.cast<double>(), high.cast<double>(), size_m));
  grid.extent_ = high - grid.low_ + VoxelIndex::Ones();
  grid.voxels_ = std::move(voxels);
  grid.index_rows();
  return grid;
}

void VoxelGrid::index_rows() {
  const std::size_t rows = std::size_t(extent_.y()) * std::size_t(extent_.z());
  row_begin_.assign(rows + 1, 0);
  for (const Voxel& voxel : voxels_) {
    const VoxelIndex i = voxel.index - low_;
    ++row_begin_[std::size_t(i.z()) * std::size_t(extent_.y()) + std::size_t(i.y()) + 1];
  }
  for (std::size_t r = 0; r < rows; ++r) row_begin_[r + 1] += row_begin_[r];
}

std::int64_t VoxelGrid::find(const VoxelIndex& index) const {
  const VoxelIndex i = index - low_;
  if ((i.array() < 0).any() || (i.array() >= extent_.array()).any()) return -1;
  const std::size_t row = std::size_t(i.z()) * std::size_t(extent_.y()) + std::size_t(i.y());
  const auto begin = voxels_.begin() + row_begin_[row], end = voxels_.begin() + row_begin_[row + 1];
  const auto found = std::lower_bound(begin, end, index.x(),
                                      [](const Voxel& v, int x) { return v.index.x() < x; });
  return found != end && found->index.x() == index.x() ? found - voxels_.begin() : -1;
}

void VoxelGrid::filter(const std::vector<std::uint8_t>& keep) {
  if (keep.size() != voxels_.size())
    throw std::invalid_argument("VoxelGrid::filter: keep must have one entry a voxel");
  std::size_t kept = 0;
  for (std::size_t i = 0; i < voxels_.size(); ++i) {
    if (keep[i]) voxels_[kept++] = voxels_[i];
  }
  voxels_.resize(kept);
  index_rows();
}

ThresholdChoice choose_min_points(const VoxelGrid& grid) {
  std::vector<std::uint32_t> counts;
  std::uint64_t total = 0;
  for (const VoxelGrid::Voxel& voxel : grid.voxels()) {
    counts.push_back(voxel.count());
    total += voxel.count();
  }
  std::sort(counts.begin(), counts.end());
  ThresholdChoice choice;
  std::uint64_t seen = 0;
  for (std::uint32_t count : counts) {
    seen += count;
    choice.typical_count = count;
    if (2 * seen >= total) break;
  }
  choice.min_points = std::max(1, static_cast<int>(std::floor(0.1 * choice.typical_count)));
  return choice;
}

std::vector<std::uint8_t> count_filter(const VoxelGrid& grid, int min_points) {
  std::vector<std::uint8_t> keep;
  keep.reserve(grid.voxels().size());
  for (const VoxelGrid::Voxel& voxel : grid.voxels())
    keep.push_back(voxel.count() >= static_cast<std::uint32_t>(min_points) ? 1 : 0);
  return keep;
}

}  // namespace turnscan::voxels
