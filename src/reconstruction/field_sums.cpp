#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/field_sums.hpp>

namespace turnscan {

namespace {

using Index = Volume::Index;
constexpr int kSide = Volume::kSide;
constexpr std::size_t kCells = detail::kBrickCells;
constexpr int kGroupSide = 4;  // bricks along a group
constexpr unsigned kAllParts = 255;

/// One clear view outweighs this many measured distances: passing through is certain, being behind
/// a surface is not.
constexpr float kClearWeight = 0.5f;
constexpr float kLeastWeight = 0.3f;  // below, a sample counts as not seen
constexpr float kLeastShare = 0.02f;  // of the typical weight, likewise

Index brick_in(const Index& first, std::size_t b) {
  return {first[0] + int(b & 3), first[1] + int(b >> 2 & 3), first[2] + int(b >> 4)};
}

/// Where a brick's sample, the first coordinate fastest, lies in its sums.
std::size_t place_in_parts(std::size_t sample) {
  const std::size_t i = sample & 7, j = sample >> 3 & 7, k = sample >> 6;
  return (i >> 2 | j >> 2 << 1 | k >> 2 << 2) << 6 | (i & 3) | (j & 3) << 2 | (k & 3) << 4;
}

/// Typical weight of a sample beside a surface: the median.
float typical_weight(const std::vector<const bricks::BrickSums*>& all, float cell) {
  std::vector<float> weights;
  for (const bricks::BrickSums* sums : all) {
    for (std::size_t sample = 0; sample < kCells; sample += 7) {
      const std::size_t at = place_in_parts(sample), i = at % bricks::kPartCells;
      const bricks::PartSums& part = sums->part[at / bricks::kPartCells];
      const float w = part.weight[i];
      if (w > 0.0f && std::abs(part.distance[i]) < w * cell) weights.push_back(w);
    }
  }
  if (weights.empty()) return 0.0f;
  const auto middle = weights.begin() + std::ptrdiff_t(weights.size() / 2);
  std::nth_element(weights.begin(), middle, weights.end());
  return *middle;
}

/// From sums to distances. Returns whether all samples are clear for sure.
bool settle_brick(const bricks::BrickSums& sums, float clear_all, float truncation, float least,
                  float* value, float* weight) {
  bool clear_throughout = true;
  for (std::size_t sample = 0; sample < kCells; ++sample) {
    const std::size_t at = place_in_parts(sample), i = at % bricks::kPartCells;
    const bricks::PartSums& part = sums.part[at / bricks::kPartCells];
    const float clear = kClearWeight * (part.clear[i] + clear_all);
    const float w = part.weight[i] + clear;
    const bool known = w >= least;
    value[sample] = known ? (part.distance[i] + clear * truncation) / w : truncation;
    weight[sample] = known ? w : 0.0f;
    clear_throughout &= known && value[sample] > 0.7f * truncation;
  }
  return clear_throughout;
}

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

void RobustBox::add(const RobustBox& other) {
  for (std::size_t a = 0; a < 3; ++a)
    values_[a].insert(values_[a].end(), other.values_[a].begin(), other.values_[a].end());
}

Box RobustBox::box() {
  constexpr double kStray = 2e-4;
  Box box;
  if (values_[0].empty()) return box;
  parallel_for(3, 1, [&](std::size_t a) {
    auto& column = values_[a];
    const auto cut = std::ptrdiff_t(kStray * double(column.size()));
    std::nth_element(column.begin(), column.begin() + cut, column.end());
    box.min[int(a)] = column[std::size_t(cut)];
    std::nth_element(column.begin(), column.end() - 1 - cut, column.end());
    box.max[int(a)] = *(column.end() - 1 - cut);
  });
  return box;
}

Vec3d FieldSums::sample_position(const Index& brick) const {
  return scale_.cell_m *
         Vec3d(double(brick[0]) * kSide, double(brick[1]) * kSide - 0.5, double(brick[2]) * kSide);
}

std::array<float, 3> FieldSums::first_sample(const Index& brick) const {
  const Vec3d p = sample_position(brick);
  return {float(p.x()), float(p.y()), float(p.z())};
}

std::size_t FieldSums::group_index(const Index& g) const {
  return std::size_t(g[0] - low_[0]) +
         std::size_t(size_[0]) *
             (std::size_t(g[1] - low_[1]) + std::size_t(size_[1]) * std::size_t(g[2] - low_[2]));
}

Volume::Index FieldSums::first_brick(std::size_t group) const {
  const auto nx = std::size_t(size_[0]), ny = std::size_t(size_[1]);
  return {kGroupSide * (low_[0] + int(group % nx)), kGroupSide * (low_[1] + int(group / nx % ny)),
          kGroupSide * (low_[2] + int(group / nx / ny))};
}

/// Of what the views measured; on a turning platter it is round, so that it hardly grows.
Box FieldSums::measured_box(std::span<const DepthView> batch) const {
  std::vector<RobustBox> own(batch.size());
  parallel_for(batch.size(), 1, [&](std::size_t v) {
    for_each_point(batch[v], [&](const Vec3f& p) {
      if (!scale_.cylinder || scale_.cylinder->contains(p.cast<double>())) own[v].add(p);
    });
  });
  RobustBox points;
  for (const RobustBox& one : own) points.add(one);
  Box box = points.box();
  if (box.empty()) return box;
  box.min.array() -= scale_.truncation_m + 2.0 * scale_.cell_m;
  box.max.array() += scale_.truncation_m + 2.0 * scale_.cell_m;
  if (scale_.cylinder) {
    if (scale_.floor_m) box.min.y() = -0.25 * scale_.cell_m;  // the lowest layer is at -0.5
    const double reach = std::max({-box.min.x(), box.max.x(), -box.min.z(), box.max.z()});
    box.min.x() = box.min.z() = -reach;
    box.max.x() = box.max.z() = reach;
  }
  return box;
}

/// Makes the table of bricks large enough for what the views measured.
Result<> FieldSums::cover(std::span<const DepthView> batch, const EarlierViews& before) {
  const Box box = measured_box(batch);
  if (box.empty()) return {};
  Index low{}, high{};
  bool covered = !groups_.empty();
  double count = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double side = scale_.cell_m * kSide * kGroupSide;
    if (!(std::abs(box.min[int(a)]) + std::abs(box.max[int(a)]) < 1e6 * side)) count = 1e30;
    const double first = sample_position({0, 0, 0})[int(a)];
    low[a] = int(std::clamp(std::floor((box.min[int(a)] - first) / side), -1e6, 1e6));
    high[a] = int(std::clamp(std::floor((box.max[int(a)] - first) / side), -1e6, 1e6)) + 1;
    if (!groups_.empty()) {
      covered &= low[a] >= low_[a] && high[a] <= low_[a] + size_[a];
      low[a] = std::min(low[a], low_[a]);
      high[a] = std::max(high[a], low_[a] + size_[a]);
    }
    count *= high[a] - low[a];
  }
  if (covered) return {};
  if (!(count * double(bricks::kGroup) < 2e7))
    return fail(ErrorCode::kResourceLimit,
                "volumetric: {:.0f} bricks of samples; choose a larger --voxel-size",
                count * double(bricks::kGroup));
  grow(low, high, before);
  return {};
}

void FieldSums::grow(const Index& low, const Index& high, const EarlierViews& before) {
  FieldSums larger(scale_);
  larger.low_ = low;
  larger.size_ = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  larger.groups_.resize(std::size_t(larger.size_[0]) * std::size_t(larger.size_[1]) *
                        std::size_t(larger.size_[2]));
  std::vector<std::size_t> added;
  for (std::size_t n = 0; n < larger.groups_.size(); ++n) {
    Index at = larger.first_brick(n);
    bool old = true;
    for (std::size_t a = 0; a < 3; ++a) {
      at[a] = floor_div(at[a], kGroupSide);
      old &= at[a] >= low_[a] && at[a] < low_[a] + size_[a];
    }
    if (old)
      larger.groups_[n] = std::move(groups_[group_index(at)]);
    else
      added.push_back(n);
  }
  groups_ = std::move(larger.groups_);
  low_ = larger.low_;
  size_ = larger.size_;
  look_back_at_groups(added, before);
}

/// Of which bricks of new groups earlier views saw past the whole.
void FieldSums::look_back_at_groups(std::span<const std::size_t> groups,
                                    const EarlierViews& before) {
  constexpr std::size_t kAtOnce = 16;
  std::vector<BrickView> views;
  for (std::size_t v = 0; v < before.views.size(); v += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, before.views.size() - v);
    views.resize(count);
    parallel_for(count, 1, [&](std::size_t i) {
      views[i].place(before.views[v + i], scale_);
      views[i].bound();
    });
    parallel_for(groups.size(), 4, [&](std::size_t n) {
      Group& group = groups_[groups[n]];
      const std::array<float, 3> first = first_sample(first_brick(groups[n]));
      for (const BrickView& view : views) {
        const Bits clear = bricks::kernel().look_at_group(*view, first.data()).clear;
        for (std::size_t b = 0; b < bricks::kGroup; ++b)
          group.clear[b] += before.weight * float(clear >> b & 1u);
      }
    });
  }
}

/// What earlier views saw of bricks in which a surface is measured for the first time.
void FieldSums::look_back_at_bricks(std::span<const Bits> made, const EarlierViews& before) {
  std::vector<std::pair<std::size_t, std::size_t>> which;
  for (std::size_t n = 0; n < made.size(); ++n) {
    for (Bits left = made[n]; left != 0; left &= left - 1)
      which.emplace_back(n, std::size_t(std::countr_zero(left)));
  }
  if (which.empty() || before.views.empty()) return;
  std::vector<BrickView> views(before.views.size());
  parallel_for(views.size(), 16, [&](std::size_t v) { views[v].place(before.views[v], scale_); });
  parallel_for(which.size(), 1, [&](std::size_t i) {
    look_back(which[i].first, which[i].second, views, before.weight);
  });
}

void FieldSums::look_back(std::size_t group, std::size_t brick, std::span<const BrickView> before,
                          float weight) {
  const Index first = first_brick(group);
  const std::array<float, 3> group_first = first_sample(first);
  const std::array<float, 3> own_first = first_sample(brick_in(first, brick));
  bricks::BrickSums seen{};
  for (const BrickView& view : before) {
    const BrickView::Sight sight = view.look_at(group_first.data(), brick);
    if (sight == BrickView::Sight::kPartly || sight == BrickView::Sight::kSurface)
      bricks::kernel().add(*view, own_first.data(), kAllParts, seen);
  }
  bricks::BrickSums& sums = *groups_[group].sums[brick];
  for (std::size_t part = 0; part < bricks::kParts; ++part) {
    for (std::size_t i = 0; i < bricks::kPartCells; ++i)
      sums.part[part].clear[i] += weight * seen.part[part].clear[i];
  }
}

/// Sums for a brick once a view measures a surface in it, with what the views of the batch up to
/// that one say; nullptr when none does. view: the number of the one after it.
std::unique_ptr<bricks::BrickSums> FieldSums::first_sums(std::span<const bricks::Sights> sights,
                                                         std::size_t brick, const float first[3],
                                                         std::size_t& view) const {
  const bricks::Kernel& kernel = bricks::kernel();
  for (view = 0; view < sights.size(); ++view) {
    if ((sights[view].surface >> brick & 1u) == 0) continue;
    const bricks::PartSights parts = kernel.look_at_parts(*batch_[view], first);
    if (parts.surface == 0) continue;
    bricks::BrickSums sums{};
    if (!kernel.add(*batch_[view], first, parts.surface | parts.partly, sums)) continue;
    for (std::size_t v = 0; v < view; ++v) {
      if (((sights[v].surface | sights[v].partly) >> brick & 1u) != 0)
        kernel.add(*batch_[v], first, kAllParts, sums);
    }
    ++view;
    return std::make_unique<bricks::BrickSums>(sums);
  }
  return nullptr;
}

/// Adds the batch to a group's bricks. Which of them it gave sums to.
FieldSums::Bits FieldSums::add_to(Group& group, const Index& first) const {
  const bricks::Kernel& kernel = bricks::kernel();
  const std::array<float, 3> group_first = first_sample(first);
  std::vector<bricks::Sights> sights(batch_.size());
  Bits some = 0, made = 0;
  for (std::size_t v = 0; v < batch_.size(); ++v) {
    sights[v] = kernel.look_at_group(*batch_[v], group_first.data());
    some |= sights[v].surface | sights[v].partly;
    for (std::size_t b = 0; b < bricks::kGroup; ++b)
      group.clear[b] += float(sights[v].clear >> b & 1u);
  }
  for (; some != 0; some &= some - 1) {
    const auto b = std::size_t(std::countr_zero(some));
    const std::array<float, 3> own = first_sample(brick_in(first, b));
    std::size_t v = 0;
    if (!group.sums[b]) {
      group.sums[b] = first_sums(sights, b, own.data(), v);
      if (!group.sums[b]) continue;
      made |= Bits(1) << b;
    }
    for (; v < batch_.size(); ++v) {
      if (((sights[v].surface | sights[v].partly) >> b & 1u) == 0) continue;
      const bricks::PartSights parts = kernel.look_at_parts(*batch_[v], own.data());
      kernel.add(*batch_[v], own.data(), parts.surface | parts.partly, *group.sums[b]);
    }
  }
  return made;
}

Result<> FieldSums::add(std::span<const DepthView> batch, const EarlierViews& before) {
  TURNSCAN_TRY(cover(batch, before));
  batch_.resize(batch.size());
  parallel_for(batch.size(), 1, [&](std::size_t v) {
    batch_[v].place(batch[v], scale_);
    batch_[v].bound();
  });
  std::vector<Bits> made(groups_.size(), 0);
  std::atomic<std::size_t> bytes{bytes_};
  parallel_for(groups_.size(), 1, [&](std::size_t n) {
    if (bytes > 2 * scale_.max_bytes) return;  // ends in an error
    made[n] = add_to(groups_[n], first_brick(n));
    bytes += std::size_t(std::popcount(made[n])) * sizeof(bricks::BrickSums);
  });
  bytes_ = bytes;
  if (bytes_ > scale_.max_bytes)
    return fail(ErrorCode::kResourceLimit,
                "volumetric: the samples need more than {} MB; choose a larger --voxel-size",
                scale_.max_bytes >> 20);
  look_back_at_bricks(made, before);
  return {};
}

FieldSums::BrickKnown FieldSums::brick(const Index& at) const {
  Index group{};
  std::size_t in = 0;
  for (std::size_t a = 3; a-- > 0;) {
    group[a] = floor_div(at[a], kGroupSide);
    if (group[a] < low_[a] || group[a] >= low_[a] + size_[a]) return {};
    in = kGroupSide * in + std::size_t(at[a] - kGroupSide * group[a]);
  }
  const Group& s = groups_[group_index(group)];
  return {s.sums[in].get(), s.clear[in]};
}

/// With less, a sample counts as not seen.
float FieldSums::least_weight() const {
  std::vector<const bricks::BrickSums*> all;
  for (const Group& group : groups_) {
    for (const auto& sums : group.sums) {
      if (sums) all.push_back(sums.get());
    }
  }
  return std::max(kLeastWeight, kLeastShare * typical_weight(all, float(scale_.cell_m)));
}

Volume FieldSums::settle(const Box& box) const {
  Volume volume;
  volume.cell_m = scale_.cell_m;
  volume.truncation_m = scale_.truncation_m;
  const double brick_m = scale_.cell_m * kSide;
  Index first{};
  for (std::size_t a = 0; a < 3; ++a) {
    const double shift = a == 1 ? -0.5 * scale_.cell_m : 0.0;
    first[a] = int(std::floor((box.min[int(a)] - shift) / brick_m));
    volume.bricks[a] = int(std::floor((box.max[int(a)] - shift) / brick_m)) - first[a] + 1;
  }
  volume.origin_m = sample_position(first);
  const std::size_t count =
      std::size_t(volume.bricks[0]) * std::size_t(volume.bricks[1]) * std::size_t(volume.bricks[2]);
  volume.slot.assign(count, -1);
  volume.uniform.assign(count, 0.0f);
  const auto truncation = float(scale_.truncation_m);
  const float least = least_weight();
  std::vector<float> value(kCells), weight(kCells);
  for (std::size_t b = 0; b < count; ++b) {
    Index at = volume.brick_at(b);
    for (std::size_t a = 0; a < 3; ++a) at[a] += first[a];
    const BrickKnown own = brick(at);
    if (own.sums == nullptr) {
      volume.uniform[b] = kClearWeight * own.clear >= least ? 1.0f : 0.0f;
    } else if (settle_brick(*own.sums, own.clear, truncation, least, value.data(), weight.data())) {
      volume.uniform[b] = 1.0f;
    } else if (std::any_of(weight.begin(), weight.end(), [](float w) { return w > 0.0f; })) {
      volume.touch(b, truncation);
      std::copy(value.begin(), value.end(), volume.value.end() - std::ptrdiff_t(kCells));
      std::copy(weight.begin(), weight.end(), volume.weight.end() - std::ptrdiff_t(kCells));
    }
  }
  return volume;
}

Volume FieldSums::settle_coarsely(std::size_t most_bricks) const {
  Index low{1 << 30, 1 << 30, 1 << 30}, high{-(1 << 30), -(1 << 30), -(1 << 30)};
  for (std::size_t n = 0; n < groups_.size(); ++n) {
    const Index first = first_brick(n);
    for (std::size_t b = 0; b < bricks::kGroup; ++b) {
      if (!groups_[n].sums[b]) continue;
      const Index at = brick_in(first, b);
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
    if (count <= double(most_bricks) || factor == 8) return coarse(factor, low, high);
  }
  return {};
}

Volume FieldSums::coarse(int factor, const Index& low, const Index& high) const {
  Volume volume;
  volume.cell_m = scale_.cell_m * factor;
  volume.truncation_m = std::max(scale_.truncation_m, 1.5 * volume.cell_m);
  Index first{};
  for (std::size_t a = 0; a < 3; ++a) {
    first[a] = floor_div(low[a], factor);
    volume.bricks[a] = floor_div(high[a], factor) - first[a] + 1;
  }
  const double middle = 0.5 * (factor - 1) * scale_.cell_m;
  volume.origin_m =
      sample_position({first[0] * factor, first[1] * factor, first[2] * factor}).array() + middle;
  const std::size_t count =
      std::size_t(volume.bricks[0]) * std::size_t(volume.bricks[1]) * std::size_t(volume.bricks[2]);
  volume.slot.assign(count, -1);
  volume.uniform.assign(count, 0.0f);
  const float least = least_weight();
  for (std::size_t b = 0; b < count; ++b) {
    Index at = volume.brick_at(b);
    for (std::size_t a = 0; a < 3; ++a) at[a] = (at[a] + first[a]) * factor;
    coarse_brick(volume, b, at, factor, least);
  }
  return volume;
}

/// Fills a brick of a coarse volume from those of factor^3 bricks that begin at `at`.
void FieldSums::coarse_brick(Volume& volume, std::size_t b, const Index& at, int factor,
                             float least) const {
  const int own_side = kSide / factor;  // coarse samples along a fine brick
  const auto truncation = float(scale_.truncation_m);
  std::vector<float> value, weight;
  float clear = 1e30f;
  std::vector<float> fine(kCells), known(kCells);
  for (int n = 0; n < factor * factor * factor; ++n) {
    const Index offset{n % factor, n / factor % factor, n / factor / factor};
    const BrickKnown own = brick({at[0] + offset[0], at[1] + offset[1], at[2] + offset[2]});
    clear = std::min(clear, own.clear);
    const bool seen_empty = own.sums == nullptr && kClearWeight * own.clear >= least;
    if (own.sums == nullptr && !seen_empty) continue;
    if (value.empty()) {
      value.assign(kCells, 0.0f);
      weight.assign(kCells, 0.0f);
    }
    if (own.sums != nullptr) {
      settle_brick(*own.sums, own.clear, truncation, least, fine.data(), known.data());
    } else {
      std::fill(fine.begin(), fine.end(), truncation);
      std::fill(known.begin(), known.end(), 1.0f);
    }
    for (std::size_t i = 0; i < kCells; ++i) {
      if (known[i] <= 0.0f) continue;
      const int x = offset[0] * own_side + int(i & 7) / factor;
      const int y = offset[1] * own_side + int(i >> 3 & 7) / factor;
      const int z = offset[2] * own_side + int(i >> 6) / factor;
      value[std::size_t(x + 8 * y + 64 * z)] += fine[i];
      weight[std::size_t(x + 8 * y + 64 * z)] += 1.0f;
    }
  }
  if (value.empty()) return;
  if (kClearWeight * clear >= least &&
      std::all_of(value.begin(), value.end(), [](float v) { return v > 0.0f; })) {
    volume.uniform[b] = 1.0f;
    return;
  }
  volume.touch(b, truncation);
  for (std::size_t i = 0; i < kCells; ++i) {
    const std::size_t to = volume.value.size() - kCells + i;
    if (weight[i] <= 0.0f) continue;
    volume.value[to] = value[i] / weight[i];
    volume.weight[to] = weight[i];
  }
}

}  // namespace turnscan
