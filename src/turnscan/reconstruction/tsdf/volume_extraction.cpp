// Converts an integrator's sums to a volume of signed distances.

#include <algorithm>
#include <cmath>
#include <turnscan/reconstruction/tsdf/integrator.hpp>

namespace turnscan::tsdf {

namespace {

/// Weight of a view that saw past a sample, in measured distances: passing through is certain,
/// being behind a surface is not.
constexpr float kFreeWeight = 0.5f;
/// Weight of measurements from which on a sample is near a surface; where mixed pixels of many
/// views meet by chance, more. One view that saw past a sample makes it free: the free space of a
/// pixel ends at the nearest depth around it.
constexpr float kMinWeight = 0.3f;

/// Position of a brick's sample, the first coordinate fastest, in its sums.
std::size_t place_in_parts(std::size_t sample) {
  const std::size_t i = sample & 7, j = sample >> 3 & 7, k = sample >> 6;
  return (i >> 2 | j >> 2 << 1 | k >> 2 << 2) << 6 | (i & 3) | (j & 3) << 2 | (k & 3) << 4;
}

/// The samples of a brick.
struct BrickDistances {
  std::vector<float> value = std::vector<float>(kBrickSamples);
  std::vector<float> weight = std::vector<float>(kBrickSamples);

  /// From sums; all_free: number of views that saw past the whole brick; least: weight of
  /// measurements from which on there is surface. Returns whether all samples are certainly free.
  bool set(const BrickSums& sums, float all_free, float truncation, float least) {
    bool free_throughout = true;
    for (std::size_t sample = 0; sample < kBrickSamples; ++sample) {
      const std::size_t at = place_in_parts(sample), i = at % kPartSamples;
      const PartSums& part = sums.part[at / kPartSamples];
      const float free = kFreeWeight * (part.free[i] + all_free);
      const float w = part.weight[i] + free;
      const bool known = free > 0.0f || part.weight[i] >= least;
      value[sample] = known ? (part.distance[i] + free * truncation) / w : truncation;
      weight[sample] = known ? w : 0.0f;
      free_throughout &= known && value[sample] > 0.7f * truncation;
    }
    return free_throughout;
  }
  void set_free(float truncation) {
    std::fill(value.begin(), value.end(), truncation);
    std::fill(weight.begin(), weight.end(), 1.0f);
  }
};

/// Sums of a coarse brick over the known samples of finer ones; empty until there is one.
struct CoarseSums {
  std::vector<float> value, weight;

  /// offset: of the fine brick among factor^3.
  void add(const BrickDistances& fine, const GridCoords& offset, int factor) {
    if (value.empty()) {
      value.assign(kBrickSamples, 0.0f);
      weight.assign(kBrickSamples, 0.0f);
    }
    const int side = kBrickSide / factor;  // coarse samples along a fine brick
    for (std::size_t i = 0; i < kBrickSamples; ++i) {
      if (fine.weight[i] <= 0.0f) continue;
      const int x = offset[0] * side + int(i & 7) / factor;
      const int y = offset[1] * side + int(i >> 3 & 7) / factor;
      const int z = offset[2] * side + int(i >> 6) / factor;
      value[sample_in_brick(x, y, z)] += fine.value[i];
      weight[sample_in_brick(x, y, z)] += 1.0f;
    }
  }
};

}  // namespace

Integrator::BrickEvidence Integrator::evidence(const GridCoords& brick) const {
  GridCoords group{};
  std::size_t in_group = 0;
  for (std::size_t a = 3; a-- > 0;) {
    group[a] = floor_div(brick[a], kGroupSide);
    in_group = kGroupSide * in_group + std::size_t(brick[a] - kGroupSide * group[a]);
  }
  const GridCoords at = minus(group, low_);
  if (!grid_.contains(at)) return {};
  const BrickGroup& g = groups_[grid_.at(at)];
  return {g.sums[in_group].get(), g.free[in_group]};
}

/// A sum of mixed pixels whose depths are random varies by the root of their number.
float Integrator::least_weight() const {
  return std::max(kMinWeight, scale_.edge_weight * std::sqrt(views_));
}

Result<Volume> Integrator::extract_volume(const Box& box, const RunContext& context) const {
  Volume volume;
  volume.cell_m = scale_.cell_m;
  volume.truncation_m = scale_.truncation_m;
  const double brick_m = scale_.cell_m * kBrickSide;
  GridCoords first{}, size{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double shift = a == 1 ? -0.5 * scale_.cell_m : 0.0;
    first[a] = int(std::floor((box.min[int(a)] - shift) / brick_m));
    size[a] = int(std::floor((box.max[int(a)] - shift) / brick_m)) - first[a] + 1;
  }
  volume.origin_m = sample_position(first);
  volume.set_bricks(size);
  const auto truncation = float(scale_.truncation_m);
  const float least = least_weight();
  BrickDistances brick;
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    if (b % 1024 == 0) TURNSCAN_TRY(context.check());
    const GridCoords at = volume.bricks.coords(b);
    const BrickEvidence own = evidence({at[0] + first[0], at[1] + first[1], at[2] + first[2]});
    if (own.sums == nullptr) {
      volume.uniform[b] = own.free > 0.0f ? 1.0f : 0.0f;
    } else if (brick.set(*own.sums, own.free, truncation, least)) {
      volume.uniform[b] = 1.0f;
    } else if (std::any_of(brick.weight.begin(), brick.weight.end(),
                           [](float w) { return w > 0.0f; })) {
      volume.allocate(b, truncation);
      std::copy(brick.value.begin(), brick.value.end(), &volume.value[volume.first_sample(b)]);
      std::copy(brick.weight.begin(), brick.weight.end(), &volume.weight[volume.first_sample(b)]);
    }
  }
  return volume;
}

Volume Integrator::extract_coarse_volume(std::size_t most_bricks) const {
  GridCoords low{1 << 30, 1 << 30, 1 << 30}, high{-(1 << 30), -(1 << 30), -(1 << 30)};
  for (std::size_t n = 0; n < groups_.size(); ++n) {
    const GridCoords first = first_brick(n);
    for (std::size_t b = 0; b < kGroupBricks; ++b) {
      if (!groups_[n].sums[b]) continue;
      const GridCoords at = brick_of_group(first, b);
      for (std::size_t a = 0; a < 3; ++a) {
        low[a] = std::min(low[a], at[a]);
        high[a] = std::max(high[a], at[a]);
      }
    }
  }
  if (high[0] < low[0]) return {};
  for (const int factor : {2, 4, 8}) {
    double count = 1.0;
    for (std::size_t a = 0; a < 3; ++a)
      count *= floor_div(high[a], factor) - floor_div(low[a], factor) + 1;
    if (count <= double(most_bricks) || factor == 8) return coarse_volume(factor, low, high);
  }
  return {};
}

/// low, high: the first and last brick with sums along each axis.
Volume Integrator::coarse_volume(int factor, const GridCoords& low, const GridCoords& high) const {
  Volume volume;
  volume.cell_m = scale_.cell_m * factor;
  volume.truncation_m = std::max(scale_.truncation_m, 1.5 * volume.cell_m);
  GridCoords first{}, size{};
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] = floor_div(low[a], factor);
    size[a] = floor_div(high[a], factor) - first[a] + 1;
  }
  const double middle = 0.5 * (factor - 1) * scale_.cell_m;
  volume.origin_m =
      sample_position({first[0] * factor, first[1] * factor, first[2] * factor}).array() + middle;
  volume.set_bricks(size);
  const float least = least_weight();
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    GridCoords at = volume.bricks.coords(b);
    for (std::size_t a = 0; a < 3; ++a) at[a] = (at[a] + first[a]) * factor;
    fill_coarse_brick(volume, b, at, factor, least);
  }
  return volume;
}

/// Fills a brick of a coarse volume from the factor^3 bricks that begin at `first`.
void Integrator::fill_coarse_brick(Volume& volume, std::size_t b, const GridCoords& first,
                                   int factor, float least) const {
  const auto truncation = float(scale_.truncation_m);
  CoarseSums sums;
  BrickDistances fine;
  float free = 1e30f;
  for (int n = 0; n < factor * factor * factor; ++n) {
    const GridCoords offset{n % factor, n / factor % factor, n / factor / factor};
    const BrickEvidence own =
        evidence({first[0] + offset[0], first[1] + offset[1], first[2] + offset[2]});
    free = std::min(free, own.free);
    if (own.sums != nullptr)
      fine.set(*own.sums, own.free, truncation, least);
    else if (own.free > 0.0f)
      fine.set_free(truncation);
    else
      continue;
    sums.add(fine, offset, factor);
  }
  if (sums.value.empty()) return;
  if (free > 0.0f &&
      std::all_of(sums.value.begin(), sums.value.end(), [](float v) { return v > 0.0f; })) {
    volume.uniform[b] = 1.0f;
    return;
  }
  volume.allocate(b, truncation);
  const std::size_t to = volume.first_sample(b);
  for (std::size_t i = 0; i < kBrickSamples; ++i) {
    if (sums.weight[i] <= 0.0f) continue;
    volume.value[to + i] = sums.value[i] / sums.weight[i];
    volume.weight[to + i] = sums.weight[i];
  }
}

}  // namespace turnscan::tsdf
