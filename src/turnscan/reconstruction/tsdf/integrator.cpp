#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/tsdf/integrator.hpp>
#include <turnscan/reconstruction/tsdf/measured_points.hpp>

namespace turnscan::tsdf {

namespace {

constexpr unsigned kAllParts = 255;

bool has_bit(std::uint64_t mask, std::size_t bit) { return (mask >> bit & 1u) != 0; }

}  // namespace

Vec3d Integrator::sample_position(const GridCoords& brick) const {
  return scale_.cell_m * Vec3d(double(brick[0]) * kBrickSide, double(brick[1]) * kBrickSide - 0.5,
                               double(brick[2]) * kBrickSide);
}

std::array<float, 3> Integrator::first_sample(const GridCoords& brick) const {
  const Vec3d p = sample_position(brick);
  return {float(p.x()), float(p.y()), float(p.z())};
}

GridCoords Integrator::first_brick(std::size_t group) const {
  const GridCoords at = grid_.coords(group);
  return {kGroupSide * (low_[0] + at[0]), kGroupSide * (low_[1] + at[1]),
          kGroupSide * (low_[2] + at[2])};
}

/// Bounding box of the samples around the views' measurements. On a turning platter it is round, so
/// that it hardly grows.
Box Integrator::volume_box(std::span<const views::DepthView> batch) const {
  Box box = measured_box(batch, scale_.cylinder);
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

/// Enlarges the table of groups to contain the views' measurements.
Result<> Integrator::cover(std::span<const views::DepthView> batch, const EarlierViews& before) {
  const Box box = volume_box(batch);
  if (box.empty()) return {};
  GridCoords low{}, high{};
  bool covered = !groups_.empty();
  double count = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double side = scale_.cell_m * kBrickSide * kGroupSide;
    if (!(std::abs(box.min[int(a)]) + std::abs(box.max[int(a)]) < 1e6 * side)) count = 1e30;
    const double first = sample_position({0, 0, 0})[int(a)];
    low[a] = int(std::clamp(std::floor((box.min[int(a)] - first) / side), -1e6, 1e6));
    high[a] = int(std::clamp(std::floor((box.max[int(a)] - first) / side), -1e6, 1e6)) + 1;
    if (!groups_.empty()) {
      const int end = low_[a] + grid_.size()[a];
      covered &= low[a] >= low_[a] && high[a] <= end;
      low[a] = std::min(low[a], low_[a]);
      high[a] = std::max(high[a], end);
    }
    count *= high[a] - low[a];
  }
  if (covered) return {};
  if (!(count * double(kGroupBricks) < 2e7))
    return fail(ErrorCode::kResourceLimit,
                "volumetric: {:.0f} bricks of samples; choose a larger --voxel-size",
                count * double(kGroupBricks));
  grow(low, high, before);
  return {};
}

void Integrator::grow(const GridCoords& low, const GridCoords& high, const EarlierViews& before) {
  const GridIndex grid(minus(high, low));
  std::vector<BrickGroup> groups(grid.count());
  std::vector<std::size_t> added;
  for (std::size_t n = 0; n < groups.size(); ++n) {
    const GridCoords at = grid.coords(n);
    const GridCoords old = {at[0] + low[0] - low_[0], at[1] + low[1] - low_[1],
                            at[2] + low[2] - low_[2]};
    if (grid_.contains(old))
      groups[n] = std::move(groups_[grid_.at(old)]);
    else
      added.push_back(n);
  }
  groups_ = std::move(groups);
  low_ = low;
  grid_ = grid;
  add_earlier_free_bricks(added, before);
}

/// Determines the bricks of new groups that earlier views saw past completely.
void Integrator::add_earlier_free_bricks(std::span<const std::size_t> groups,
                                         const EarlierViews& before) {
  constexpr std::size_t kAtOnce = 16;
  std::vector<RangeBounds> views;
  for (std::size_t v = 0; v < before.views.size(); v += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, before.views.size() - v);
    views.resize(count);
    parallel_for(count, 1, [&](std::size_t i) {
      views[i].set_view(before.views[v + i], scale_);
      views[i].compute();
    });
    parallel_for(groups.size(), 4, [&](std::size_t n) {
      BrickGroup& group = groups_[groups[n]];
      const std::array<float, 3> first = first_sample(first_brick(groups[n]));
      for (const RangeBounds& view : views) {
        const BrickMask free = BrickKernels::current().group_visibility(*view, first.data()).free;
        for (std::size_t b = 0; b < kGroupBricks; ++b)
          group.free[b] += before.weight * float(free >> b & 1u);
      }
    });
  }
}

/// Adds the free space of earlier views in bricks in which a surface is measured for the first
/// time.
Result<> Integrator::add_earlier_free_samples(std::span<const BrickMask> made,
                                              const EarlierViews& before,
                                              const RunContext& context) {
  std::vector<std::pair<std::size_t, std::size_t>> which;  // group, brick
  for (std::size_t n = 0; n < made.size(); ++n) {
    for (BrickMask left = made[n]; left != 0; left &= left - 1)
      which.emplace_back(n, std::size_t(std::countr_zero(left)));
  }
  if (which.empty() || before.views.empty()) return {};
  std::vector<RangeBounds> views(before.views.size());
  parallel_for(views.size(), 16,
               [&](std::size_t v) { views[v].set_view(before.views[v], scale_); });
  return parallel_for(which.size(), 1, context, [&](std::size_t i) {
    add_earlier_free_samples(which[i].first, which[i].second, views, before.weight);
  });
}

void Integrator::add_earlier_free_samples(std::size_t group, std::size_t brick,
                                          std::span<const RangeBounds> before, float weight) {
  const GridCoords first = first_brick(group);
  const std::array<float, 3> group_first = first_sample(first);
  const std::array<float, 3> brick_first = first_sample(brick_of_group(first, brick));
  BrickSums seen{};
  for (const RangeBounds& view : before) {
    const Visibility visibility = view.visibility(group_first.data(), brick);
    if (visibility == Visibility::kPartlyFree || visibility == Visibility::kNearSurface)
      BrickKernels::current().integrate(*view, brick_first.data(), kAllParts, seen);
  }
  BrickSums& sums = *groups_[group].sums[brick];
  for (std::size_t part = 0; part < kParts; ++part) {
    for (std::size_t i = 0; i < kPartSamples; ++i)
      sums.part[part].free[i] += weight * seen.part[part].free[i];
  }
}

/// Sums for a brick once a view measures a surface in it, including the views of the batch up to
/// that one; nullptr if none does. view: the index after that view.
std::unique_ptr<BrickSums> Integrator::first_sums(std::span<const VisibilityMasks> visibility,
                                                  std::size_t brick, const float first[3],
                                                  std::size_t& view) const {
  const BrickKernel& kernel = BrickKernels::current();
  for (view = 0; view < visibility.size(); ++view) {
    if (!has_bit(visibility[view].near_surface, brick)) continue;
    const PartVisibilityMasks parts = kernel.part_visibility(*batch_[view], first);
    if (parts.near_surface == 0) continue;
    BrickSums sums{};
    if (!kernel.integrate(*batch_[view], first, parts.near_surface | parts.partly_free, sums))
      continue;
    for (std::size_t v = 0; v < view; ++v) {
      if (has_bit(visibility[v].near_surface | visibility[v].partly_free, brick))
        kernel.integrate(*batch_[v], first, kAllParts, sums);
    }
    ++view;
    return std::make_unique<BrickSums>(sums);
  }
  return nullptr;
}

/// Integrates the batch into a group's bricks. Returns those that got sums.
Integrator::BrickMask Integrator::integrate_into(BrickGroup& group, const GridCoords& first) const {
  const BrickKernel& kernel = BrickKernels::current();
  const std::array<float, 3> group_first = first_sample(first);
  std::vector<VisibilityMasks> visibility(batch_.size());
  BrickMask some = 0, made = 0;
  for (std::size_t v = 0; v < batch_.size(); ++v) {
    visibility[v] = kernel.group_visibility(*batch_[v], group_first.data());
    some |= visibility[v].near_surface | visibility[v].partly_free;
    for (std::size_t b = 0; b < kGroupBricks; ++b)
      group.free[b] += float(visibility[v].free >> b & 1u);
  }
  for (; some != 0; some &= some - 1) {
    const auto b = std::size_t(std::countr_zero(some));
    const std::array<float, 3> own = first_sample(brick_of_group(first, b));
    std::size_t v = 0;
    if (!group.sums[b]) {
      group.sums[b] = first_sums(visibility, b, own.data(), v);
      if (!group.sums[b]) continue;
      made |= BrickMask(1) << b;
    }
    for (; v < batch_.size(); ++v) {
      if (!has_bit(visibility[v].near_surface | visibility[v].partly_free, b)) continue;
      const PartVisibilityMasks parts = kernel.part_visibility(*batch_[v], own.data());
      kernel.integrate(*batch_[v], own.data(), parts.near_surface | parts.partly_free,
                       *group.sums[b]);
    }
  }
  return made;
}

Result<> Integrator::integrate(std::span<const views::DepthView> batch, const EarlierViews& before,
                               const RunContext& context) {
  TURNSCAN_TRY(cover(batch, before));
  batch_.resize(batch.size());
  parallel_for(batch.size(), 1, [&](std::size_t v) {
    batch_[v].set_view(batch[v], scale_);
    batch_[v].compute();
  });
  views_ += float(batch.size());
  std::vector<BrickMask> made(groups_.size(), 0);
  std::atomic<std::size_t> bytes{bytes_};
  const auto integrate_group = [&](std::size_t n) {
    if (bytes > 2 * scale_.max_bytes) return;  // results in an error
    made[n] = integrate_into(groups_[n], first_brick(n));
    bytes += std::size_t(std::popcount(made[n])) * sizeof(BrickSums);
  };
  TURNSCAN_TRY(parallel_for(groups_.size(), 1, context, integrate_group));
  bytes_ = bytes;
  if (bytes_ > scale_.max_bytes)
    return fail(ErrorCode::kResourceLimit,
                "volumetric: the samples need more than {} MB; choose a larger --voxel-size",
                scale_.max_bytes >> 20);
  return add_earlier_free_samples(made, before, context);
}

}  // namespace turnscan::tsdf
