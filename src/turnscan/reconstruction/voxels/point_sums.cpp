#include <algorithm>
#include <cmath>
#include <deque>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/random.hpp>
#include <turnscan/reconstruction/voxels/key_sort.hpp>
#include <turnscan/reconstruction/voxels/point_sums.hpp>
#include <turnscan/reconstruction/voxels/sub_voxel_line.hpp>

namespace turnscan::voxels {

namespace {

constexpr int kPlaceBits = 12;                     // of a position within its cell
constexpr std::int64_t kPlaces = 1 << kPlaceBits;  // along a cell
constexpr float kDirections = 2048.0f;             // steps of a unit vector's component
/// 2^20 times the largest position or direction still fits 32 bits.
constexpr std::uint32_t kMaxPoints = (1U << 20) - 1;
/// A brick contains 2 x 2 x 2 voxels of 2 x 2 x 2 cells, voxel by voxel.
constexpr int kBrickBits = 2;
constexpr std::size_t kVoxels = 8, kCells = 8;
constexpr std::size_t kParts = 64;
/// Cells are numbered from the lowest allowed one.
constexpr std::int64_t kMaxCells = std::int64_t{1} << 21;
constexpr double kOffset = double(kMaxCells * kPlaces);

}  // namespace

/// Sums over the points of a cell.
struct CellSums {
  std::uint32_t count = 0;
  std::array<std::int32_t, 3> place{}, towards{};
};
using CellBrick = std::array<CellSums, kVoxels * kCells>;

namespace {

using BrickColors = std::array<std::array<std::uint32_t, 3>, kVoxels * kCells>;

/// A point in the form in which a brick stores it.
struct Entry {
  std::uint64_t brick;
  std::uint16_t cell;                   ///< in the brick: voxel * 8 + cell of the voxel
  std::array<std::int16_t, 3> place;    ///< from the middle of the cell
  std::array<std::int16_t, 3> towards;  ///< to the sensor
  Rgb color;
};

/// Points of a frame, sorted by the part that stores them.
struct Sorted {
  std::vector<Entry> entries;
  std::array<std::uint32_t, kParts + 1> begin{};
  bool outside = false;  ///< a point is too far away
};

std::uint64_t spread_key(std::int64_t x, std::int64_t y, std::int64_t z) {
  return (std::uint64_t(z) << 42) | (std::uint64_t(y) << 21) | std::uint64_t(x);
}
/// The brick's lowest voxel.
VoxelIndex low_voxel(std::uint64_t brick) {
  constexpr std::uint64_t kMask = (1ULL << 21) - 1;
  constexpr int kLow = int(kMaxCells / 2);
  return {2 * int(brick & kMask) - kLow, 2 * int((brick >> 21) & kMask) - kLow,
          2 * int(brick >> 42) - kLow};
}
/// Coordinates 0 or 1 of the k-th octant.
VoxelIndex octant(std::size_t k) { return {int(k & 1), int((k >> 1) & 1), int((k >> 2) & 1)}; }

std::size_t part_of(std::uint64_t brick) { return std::size_t(mix64(brick) >> 58); }

/// Positions are floored by truncation: shifted by kOffset they are positive.
bool to_entry(const Vec3d& p, const Vec3f& towards, double scale, Entry& entry) {
  std::array<std::int64_t, 3> cell{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double shifted = p[int(a)] * scale + kOffset;
    if (!(shifted >= 0.0) || !(shifted < 2.0 * kOffset)) return false;
    const auto place = static_cast<std::int64_t>(shifted);
    cell[a] = place >> kPlaceBits;
    entry.place[a] = static_cast<std::int16_t>((place & (kPlaces - 1)) - kPlaces / 2);
    entry.towards[a] = static_cast<std::int16_t>(
        static_cast<int>(towards[int(a)] * kDirections + (kDirections + 0.5f)) - int(kDirections));
  }
  entry.brick = spread_key(cell[0] >> kBrickBits, cell[1] >> kBrickBits, cell[2] >> kBrickBits);
  const auto bits = [&](int shift) {
    return ((cell[0] >> shift) & 1) | (((cell[1] >> shift) & 1) << 1) |
           (((cell[2] >> shift) & 1) << 2);
  };
  entry.cell = static_cast<std::uint16_t>((bits(1) << 3) | bits(0));
  return true;
}

Sorted sort(const PointsSeen& frame, const Vec3d& origin_m, double scale) {
  Sorted out;
  const std::size_t n = frame.points.size();
  std::vector<Entry> entries(n);
  std::vector<std::uint8_t> part(n);
  const Vec3f view = frame.viewpoint.value.cast<float>();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3f& p = frame.points[i];
    const Vec3f d = view - p;
    const float squared = d.squaredNorm();
    const Vec3f towards = frame.viewpoint.parallel ? view
                          : squared > 0.0f         ? Vec3f(d * (1.0f / std::sqrt(squared)))
                                                   : Vec3f(Vec3f::Zero());
    if (!to_entry(p.cast<double>() - origin_m, towards, scale, entries[i])) {
      out.outside = true;
      return out;
    }
    if (!frame.colors.empty()) entries[i].color = frame.colors[i];
    part[i] = static_cast<std::uint8_t>(part_of(entries[i].brick));
    ++out.begin[part[i] + 1U];
  }
  for (std::size_t k = 0; k < kParts; ++k) out.begin[k + 1] += out.begin[k];
  std::array<std::uint32_t, kParts> place{};
  std::copy_n(out.begin.begin(), kParts, place.begin());
  out.entries.resize(n);
  for (std::size_t i = 0; i < n; ++i) out.entries[place[part[i]]++] = entries[i];
  return out;
}

/// An occupied voxel of any part.
struct VoxelRef {
  VoxelIndex index;
  std::uint32_t part, brick, voxel;
  std::uint32_t cells = 0, points = 0;
};

}  // namespace

/// The bricks of one part, in the order in which they were first used.
class PointSums::Part {
 public:
  Part(int sub_voxels, bool whole_chord) : sub_voxels_(sub_voxels), whole_chord_(whole_chord) {}

  void add(std::span<const Entry> entries, bool colored) {
    for (const Entry& entry : entries) {
      const std::uint32_t b = find(entry.brick);
      CellSums& cell = bricks_[b][entry.cell];
      if (sub_voxels_ > 0) walk(entry, b);
      if (cell.count++ >= kMaxPoints) continue;
      for (std::size_t a = 0; a < 3; ++a) {
        cell.place[a] += entry.place[a];
        cell.towards[a] += entry.towards[a];
      }
      if (!colored) continue;
      if (colors_.size() <= b) colors_.resize(b + 1U);
      auto& color = colors_[b][entry.cell];
      color[0] += entry.color.r, color[1] += entry.color.g, color[2] += entry.color.b;
    }
  }
  void forget_colors() { colors_.clear(); }

  std::size_t bytes() const {
    return bricks_.size() * sizeof(CellBrick) + colors_.size() * sizeof(BrickColors) +
           sub_counts_.size() * kVoxels * std::size_t(sub_voxels_) * std::size_t(sub_voxels_) *
               std::size_t(sub_voxels_) * sizeof(std::uint32_t) +
           table_.size() * sizeof(std::uint32_t) + keys_.size() * sizeof(std::uint64_t);
  }

  void list(std::uint32_t part, std::vector<VoxelRef>& out) const {
    for (std::uint32_t b = 0; b < bricks_.size(); ++b) {
      for (std::uint32_t v = 0; v < kVoxels; ++v) {
        VoxelRef ref{low_voxel(keys_[b]) + octant(v), part, b, v};
        for (std::size_t c = 0; c < kCells; ++c) {
          const std::uint32_t count = bricks_[b][v * kCells + c].count;
          ref.points += count;
          ref.cells += count > 0 ? 1 : 0;
        }
        if (ref.points > 0) out.push_back(ref);
      }
    }
  }

  /// Writes the cells of a voxel starting at position `at`.
  void write(const VoxelRef& ref, double cell_m, const Vec3d& origin_m, std::size_t at,
             MeasuredCells& out) const {
    for (std::size_t c = 0; c < kCells; ++c) {
      const std::size_t k = ref.voxel * kCells + c;
      const CellSums& cell = bricks_[ref.brick][k];
      if (cell.count == 0) continue;
      const double n = std::min(cell.count, kMaxPoints);
      const VoxelIndex low = 2 * ref.index + octant(c);
      for (std::size_t a = 0; a < 3; ++a) {
        // Positions were floored: adds half a step on average.
        const double place = (cell.place[a] / n + 0.5) / double(kPlaces) + 0.5;
        out.columns[a][at] = static_cast<float>((low[int(a)] + place) * cell_m + origin_m[int(a)]);
        out.columns[3 + a][at] = static_cast<float>(cell.towards[a] / n / double(kDirections));
      }
      out.columns[6][at] = static_cast<float>(cell.count);
      if (!out.colors.empty()) {
        const auto& sum = colors_[ref.brick][k];
        const auto mean = [&](std::uint32_t s) { return std::uint8_t(std::lround(s / n)); };
        out.colors[at] = {mean(sum[0]), mean(sum[1]), mean(sum[2])};
      }
      ++at;
    }
  }

  const std::uint32_t* sub_counts(const VoxelRef& ref) const {
    return sub_counts_[ref.brick].data() + ref.voxel * cube(sub_voxels_);
  }

 private:
  static std::size_t cube(int s) { return std::size_t(s) * std::size_t(s) * std::size_t(s); }

  std::uint32_t find(std::uint64_t brick) {
    if (!keys_.empty() && keys_[last_] == brick) return last_;
    if (2 * keys_.size() >= table_.size()) grow();
    std::size_t slot = slot_of(brick);
    while (table_[slot] != kEmpty && keys_[table_[slot]] != brick)
      slot = (slot + 1) & (table_.size() - 1);
    if (table_[slot] == kEmpty) {
      table_[slot] = std::uint32_t(keys_.size());
      keys_.push_back(brick);
      bricks_.emplace_back();
      if (sub_voxels_ > 0) sub_counts_.emplace_back(kVoxels * cube(sub_voxels_), 0U);
    }
    return last_ = table_[slot];
  }
  std::size_t slot_of(std::uint64_t brick) const {
    return std::size_t(mix64(brick)) & (table_.size() - 1);
  }
  void grow() {
    table_.assign(std::max<std::size_t>(64, 2 * table_.size()), kEmpty);
    for (std::uint32_t b = 0; b < keys_.size(); ++b) {
      std::size_t slot = slot_of(keys_[b]);
      while (table_[slot] != kEmpty) slot = (slot + 1) & (table_.size() - 1);
      table_[slot] = b;
    }
  }

  /// Counts the line through sensor and point in the sub-voxels that it crosses.
  void walk(const Entry& entry, std::uint32_t brick) {
    const int s = sub_voxels_;
    const VoxelIndex cell = octant(entry.cell % kCells);
    Vec3d p, d;
    for (int a = 0; a < 3; ++a) {
      const double place = (entry.place[std::size_t(a)] + 0.5) / double(kPlaces) + 0.5;
      p[a] = 0.5 * (cell[a] + place) * s;
      d[a] = entry.towards[std::size_t(a)] / double(kDirections);
    }
    std::uint32_t* counts = sub_counts_[brick].data() + (entry.cell / kCells) * cube(s);
    walk_sub_voxels(p, d, s, whole_chord_,
                    [&](int x, int y, int z) { ++counts[std::size_t((z * s + y) * s + x)]; });
  }

  static constexpr std::uint32_t kEmpty = 0xffffffffU;
  int sub_voxels_;
  bool whole_chord_;
  std::vector<std::uint32_t> table_;  ///< open addressing: positions in keys_
  std::vector<std::uint64_t> keys_;
  std::uint32_t last_ = 0;
  std::deque<CellBrick> bricks_;
  std::deque<BrickColors> colors_;
  std::deque<std::vector<std::uint32_t>> sub_counts_;
};

PointSums::PointSums(double voxel_m, const CandidateOptions& options, const Vec3d& origin_m)
    : voxel_m_(voxel_m), origin_m_(origin_m), options_(options) {
  if (!(voxel_m > 0.0)) throw std::invalid_argument("PointSums: voxel_m must be positive");
  const int s = options.method == CandidateMethod::kSubVoxel ? options.subdivisions : 0;
  for (std::size_t k = 0; k < kParts; ++k)
    parts_.push_back(std::make_unique<Part>(s, options.line == SubVoxelLine::kChord));
}
PointSums::PointSums(PointSums&&) noexcept = default;
PointSums& PointSums::operator=(PointSums&&) noexcept = default;
PointSums::~PointSums() = default;

Result<> PointSums::add(std::span<const PointsSeen> frames) {
  const double scale = 2.0 * double(kPlaces) / voxel_m_;
  std::vector<Sorted> sorted(frames.size());
  parallel_for(frames.size(), 1,
               [&](std::size_t i) { sorted[i] = sort(frames[i], origin_m_, scale); });
  for (const Sorted& frame : sorted) {
    if (frame.outside)
      return fail(ErrorCode::kInvalidOption,
                  "voxel-size {} is too small: points lie more than a million voxels from the "
                  "turntable's centre; choose a larger one, or a crop",
                  format_quantity(voxel_m_, Quantity::kLength));
  }
  for (const PointsSeen& frame : frames) {
    points_ += frame.points.size();
    if (frame.points.empty() || !frame.colors.empty() || !colored_) continue;
    colored_ = false;
    for (auto& part : parts_) part->forget_colors();
  }
  parallel_for(kParts, 1, [&](std::size_t k) {
    for (const Sorted& frame : sorted)
      parts_[k]->add(
          std::span(frame.entries).subspan(frame.begin[k], frame.begin[k + 1] - frame.begin[k]),
          colored_);
  });
  return {};
}

std::size_t PointSums::bytes() const {
  std::size_t sum = 0;
  for (const auto& part : parts_) sum += part->bytes();
  return sum;
}

namespace {

/// Sorts the voxels in the order of the coarse voxels of `joined` voxels along each side.
Result<std::vector<VoxelRef>> in_order(std::vector<VoxelRef> refs, int joined,
                                       const RunContext& context) {
  VoxelIndex low = VoxelIndex::Constant(1 << 30), high = -low;
  for (VoxelRef& ref : refs) {
    low = low.cwiseMin(ref.index);
    high = high.cwiseMax(ref.index);
  }
  const auto coarse = [&](const VoxelIndex& fine) -> VoxelIndex {
    return (fine.cast<double>() / joined).array().floor().cast<int>();
  };
  low = coarse(low);
  const VoxelIndex extent = coarse(high) - low + VoxelIndex::Ones();
  const auto key = [&](const VoxelIndex& fine) {
    const VoxelIndex i = coarse(fine) - low;
    return (std::uint64_t(i.z()) * std::uint64_t(extent.y()) + std::uint64_t(i.y())) *
               std::uint64_t(extent.x()) +
           std::uint64_t(i.x());
  };
  std::vector<KeyedItem> items(refs.size());
  parallel_for(refs.size(), 16384, [&](std::size_t i) {
    items[i] = {key(refs[i].index), std::uint32_t(i)};
  });
  TURNSCAN_TRY(context.check());
  sort_by_key(items, key(high));
  std::vector<VoxelRef> out;
  out.reserve(refs.size());
  for (const KeyedItem& item : items) out.push_back(refs[item.item]);
  return out;
}

/// Joins fine voxels; returns the position of the first fine one of each, and one more.
std::vector<VoxelGrid::Voxel> join(const std::vector<VoxelRef>& refs, int joined,
                                   std::vector<std::uint32_t>& first) {
  std::vector<VoxelGrid::Voxel> voxels;
  std::uint32_t cells = 0;
  for (std::uint32_t i = 0; i < refs.size(); ++i) {
    const VoxelIndex index = (refs[i].index.cast<double>() / joined).array().floor().cast<int>();
    if (voxels.empty() || voxels.back().index != index) {
      voxels.push_back({index, cells, cells, 0});
      first.push_back(i);
    }
    cells += refs[i].cells;
    voxels.back().end = cells;
    voxels.back().points += refs[i].points;
  }
  first.push_back(std::uint32_t(refs.size()));
  return voxels;
}

/// Centre of the i-th of a voxel's s^3 sub-voxels, in voxels from the grid's origin.
Vec3d sub_voxel_center(const VoxelRef& ref, int i, int s) {
  const Vec3d cell(i % s + 0.5, i / s % s + 0.5, i / s / s + 0.5);
  return ref.index.cast<double>() + cell / s;
}

/// The sub-voxels with the highest count in these voxels, which become one.
template <class Counts>
void add_peaks(std::span<const VoxelRef> refs, const Counts& counts, int s, double voxel_m,
               const Vec3d& origin_m, MeasuredCells& out) {
  const int cells = s * s * s;
  std::uint32_t highest = 1;
  for (const VoxelRef& ref : refs)
    highest = std::max(highest, *std::max_element(counts(ref), counts(ref) + cells));
  Peak peak{std::uint32_t(out.peak_points.size()), 0};
  for (const VoxelRef& ref : refs) {
    const std::uint32_t* count = counts(ref);
    for (int i = 0; i < cells; ++i) {
      if (count[i] != highest) continue;
      out.peak_points.push_back((sub_voxel_center(ref, i, s) * voxel_m + origin_m).cast<float>());
    }
  }
  peak.end = std::uint32_t(out.peak_points.size());
  out.peaks.push_back(peak);
}

}  // namespace

Result<MeasuredCells> PointSums::collect(int joined, const RunContext& context) const {
  if (points_ == 0) return fail(ErrorCode::kTooFewPoints, "voxels: there are no points to count");
  std::vector<std::vector<VoxelRef>> lists(kParts);
  parallel_for(kParts, 1, [&](std::size_t k) { parts_[k]->list(std::uint32_t(k), lists[k]); });
  std::vector<VoxelRef> refs;
  for (const auto& list : lists) refs.insert(refs.end(), list.begin(), list.end());
  TURNSCAN_ASSIGN(refs, in_order(std::move(refs), joined, context));
  std::vector<std::uint32_t> first;
  std::vector<VoxelGrid::Voxel> voxels = join(refs, joined, first);
  MeasuredCells out;
  const std::size_t cells = voxels.back().end;
  for (auto& column : out.columns) column.resize(cells + MeasuredCells::kPadding);
  if (colored_) out.colors.resize(cells);
  parallel_for(voxels.size(), 1024, [&](std::size_t v) {
    std::size_t at = voxels[v].begin;
    for (std::uint32_t i = first[v]; i < first[v + 1]; ++i) {
      parts_[refs[i].part]->write(refs[i], 0.5 * voxel_m_, origin_m_, at, out);
      at += refs[i].cells;
    }
  });
  TURNSCAN_TRY(context.check());
  if (options_.method == CandidateMethod::kSubVoxel) {
    const auto counts = [&](const VoxelRef& ref) { return parts_[ref.part]->sub_counts(ref); };
    for (std::size_t v = 0; v + 1 < first.size(); ++v)
      add_peaks(std::span(refs).subspan(first[v], first[v + 1] - first[v]), counts,
                options_.subdivisions, voxel_m_, origin_m_, out);
  }
  TURNSCAN_ASSIGN(out.grid, VoxelGrid::of_counted(std::move(voxels), joined * voxel_m_, origin_m_));
  return out;
}

PointCloud PointSums::sub_voxels() const {
  PointCloud out;
  if (options_.method != CandidateMethod::kSubVoxel) return out;
  const int s = options_.subdivisions;
  for (const auto& part : parts_) {
    std::vector<VoxelRef> refs;
    part->list(0, refs);
    for (const VoxelRef& ref : refs) {
      const std::uint32_t* counts = part->sub_counts(ref);
      for (int i = 0; i < s * s * s; ++i) {
        if (counts[i] == 0) continue;
        out.points.push_back((sub_voxel_center(ref, i, s) * voxel_m_ + origin_m_).cast<float>());
        out.weights.push_back(float(counts[i]));
      }
    }
  }
  return out;
}

}  // namespace turnscan::voxels
