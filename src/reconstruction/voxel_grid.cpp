#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/voxel_grid.hpp>
#include <utility>

namespace turnscan {

namespace {

constexpr int kMaxSide = 1 << 21;
/// Rows (z, y) are indexed directly; more than this would be a cloud of a few points far apart.
constexpr std::uint64_t kMaxRows = 1ULL << 26;
constexpr std::uint32_t kRadixBits = 11;

struct KeyedPoint {
  std::uint64_t key;
  std::uint32_t point;
};

constexpr std::size_t kDigits = std::size_t{1} << kRadixBits;
constexpr std::size_t kSlice = std::size_t{1} << 18;  // items that one thread counts and moves

/// Where each slice puts its items of each digit: behind those of smaller digits, and of earlier
/// slices, which keeps the order of equal keys.
void to_places(std::vector<std::array<std::uint32_t, kDigits>>& counts) {
  std::uint32_t place = 0;
  for (std::size_t d = 0; d < kDigits; ++d)
    for (auto& of_slice : counts) place += std::exchange(of_slice[d], place);
}

/// Stable radix sort by key: points of one voxel stay in ascending order.
void sort_by_key(std::vector<KeyedPoint>& items, std::uint64_t max_key) {
  std::vector<KeyedPoint> other(items.size());
  std::vector<std::array<std::uint32_t, kDigits>> places((items.size() + kSlice - 1) / kSlice);
  for (std::uint32_t shift = 0; shift < 64 && (max_key >> shift) != 0; shift += kRadixBits) {
    const auto digit = [shift](const KeyedPoint& item) {
      return std::size_t(item.key >> shift) & (kDigits - 1);
    };
    const auto each_of = [&](std::size_t slice, const auto& visit) {
      const std::size_t end = std::min(items.size(), (slice + 1) * kSlice);
      for (std::size_t i = slice * kSlice; i < end; ++i) visit(items[i], places[slice]);
    };
    parallel_for(places.size(), 1, [&](std::size_t slice) {
      places[slice].fill(0);
      each_of(slice, [&](const KeyedPoint& item, auto& count) { ++count[digit(item)]; });
    });
    to_places(places);
    parallel_for(places.size(), 1, [&](std::size_t slice) {
      each_of(slice,
              [&](const KeyedPoint& item, auto& place) { other[place[digit(item)]++] = item; });
    });
    items.swap(other);
  }
}

}  // namespace

OptionTable describe(VoxelOptions& o) {
  OptionTable table;
  table
      .number("voxel-size", o.size_m, Quantity::kLength, {1e-5, 1.0},
              "Edge of a voxel; automatic: from noise and density")
      .number("voxel-grid", o.grid, {2, 100000},
              "Or: number of voxels along the longest side (the thesis uses 150)")
      .number("voxel-min-points", o.min_points, {1, 1e9},
              "M: voxels with fewer points are dropped; automatic: a tenth of the typical count");
  return table;
}

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
  if (!((high - low).maxCoeff() < kMaxSide) || !(low.cwiseAbs().maxCoeff() < 1e9) ||
      (high.y() - low.y() + 1) * (high.z() - low.z() + 1) > double(kMaxRows))
    return fail(ErrorCode::kInvalidOption,
                "voxel-size {} is too small for a cloud of {:.3g} m; choose a larger one",
                format_quantity(size_m, Quantity::kLength), box.size().maxCoeff());
  grid.low_ = low.cast<int>();
  grid.extent_ = (high - low).cast<int>() + VoxelIndex::Ones();
  std::vector<KeyedPoint> items(points.size());
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
    grid.order_[i] = items[i].point;
    const std::uint64_t k = items[i].key;
    if (i == 0 || k != items[i - 1].key) {
      const VoxelIndex local(int(k % nx), int(k / nx % ny), int(k / nx / ny));
      grid.voxels_.push_back({grid.low_ + local, i, i});
    }
    grid.voxels_.back().end = i + 1;
  }
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

}  // namespace turnscan
