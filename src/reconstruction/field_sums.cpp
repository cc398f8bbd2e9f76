#include <algorithm>
#include <atomic>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/field_sums.hpp>

namespace turnscan {

namespace {

using Index = Volume::Index;
constexpr int kSide = Volume::kSide;
constexpr std::size_t kCells = detail::kBrickCells;

/// One clear view outweighs this many measured distances: passing through is certain, being behind
/// a surface is not.
constexpr float kClearWeight = 0.5f;
constexpr float kLeastWeight = 0.3f;  // below, a sample counts as not seen
constexpr float kLeastShare = 0.02f;  // of the typical weight, likewise

/// kSurface: it may have measured a surface there; kPartly: it may have seen past some of it.
enum class Sight { kNothing, kClear, kPartly, kSurface };

/// What a view can say about a ball, from its tiles.
class BallTest {
 public:
  BallTest(const DepthView& view, float radius_m, float truncation_m)
      : view_(view), radius_(radius_m), truncation_(truncation_m) {}

  Sight operator()(const Vec3f& center_table) const {
    const Vec3f c = view_.rotation * center_table + view_.translation;
    if (!view_.parallel && c.z() < 2.0f * radius_) return Sight::kNothing;
    // Distortion of the lens across the ball is within the widened radius.
    const Eigen::Vector2f middle = view_.project(c);
    const float u = middle.x(), v = middle.y();
    const float reach = 1.1f * radius_ / (view_.parallel ? 1.0f : c.z() - radius_);
    const float du = reach * view_.fx + 1.0f, dv = reach * view_.fy + 1.0f;
    if (!(u + du > 0.0f) || !(v + dv > 0.0f) || !(u - du < float(view_.width)) ||
        !(v - dv < float(view_.height)))
      return Sight::kNothing;
    const int x0 = std::max(0, int(u - du) / DepthView::kTile);
    const int y0 = std::max(0, int(v - dv) / DepthView::kTile);
    const int x1 = std::min(view_.tiles_x - 1, int(u + du) / DepthView::kTile);
    const int y1 = std::min(view_.tiles_y - 1, int(v + dv) / DepthView::kTile);
    DepthView::Tile all;
    for (int ty = y0; ty <= y1; ++ty) {
      for (int tx = x0; tx <= x1; ++tx)
        join(all, view_.tiles[std::size_t(ty * view_.tiles_x + tx)]);
    }
    return judge(all, c.z());
  }

 private:
  static void join(DepthView::Tile& all, const DepthView::Tile& t) {
    all.nearest = std::min(all.nearest, t.nearest);
    all.farthest = std::max(all.farthest, t.farthest);
    all.clear = std::min(all.clear, t.clear);
    all.clear_most = std::max(all.clear_most, t.clear_most);
  }

  Sight judge(const DepthView::Tile& t, float z) const {
    const auto metres = [&](std::uint16_t raw) { return raw * view_.unit_m + view_.bias_m; };
    const float front = z - radius_ - truncation_, back = z + radius_ + truncation_;
    const bool surface = t.farthest > 0 && metres(t.nearest) < back && metres(t.farthest) > front;
    if (surface) return Sight::kSurface;
    if (t.clear > 0 && metres(t.clear) > back) return Sight::kClear;
    if (t.clear_most > 0 && metres(t.clear_most) > front) return Sight::kPartly;
    return Sight::kNothing;
  }

  const DepthView& view_;
  float radius_, truncation_;
};

Index brick_in(const Index& first, std::size_t b) {
  return {first[0] + int(b & 3), first[1] + int(b >> 2 & 3), first[2] + int(b >> 4)};
}

bool measured_any(const detail::BrickSums& sums) {
  return std::any_of(sums.weight, sums.weight + kCells, [](float w) { return w > 0.0f; });
}

detail::FieldScale field_scale(const VolumeScale& scale) {
  return {float(scale.truncation_m), float(scale.behind_m), scale.edge_weight};
}

/// Radius of the ball around so many samples along each side.
float ball_radius(int side, double cell_m) { return float(0.5 * std::sqrt(3.0) * side * cell_m); }

Vec3f ball_center(const Vec3d& first, int side, double cell_m) {
  return (first.array() + 0.5 * (side - 1) * cell_m).matrix().cast<float>();
}

/// Typical weight of a sample beside a surface: the median.
float typical_weight(const std::vector<const detail::BrickSums*>& bricks, float cell) {
  std::vector<float> weights;
  for (const detail::BrickSums* sums : bricks) {
    if (sums == nullptr) continue;
    for (std::size_t i = 0; i < kCells; i += 7) {
      const float w = sums->weight[i];
      if (w > 0.0f && std::abs(sums->distance[i]) < w * cell) weights.push_back(w);
    }
  }
  if (weights.empty()) return 0.0f;
  const auto middle = weights.begin() + std::ptrdiff_t(weights.size() / 2);
  std::nth_element(weights.begin(), middle, weights.end());
  return *middle;
}

/// From sums to distances. Returns whether all samples are clear for sure.
bool settle_brick(const detail::BrickSums& sums, float clear_all, float truncation, float least,
                  float* value, float* weight) {
  bool clear_throughout = true;
  for (std::size_t i = 0; i < kCells; ++i) {
    const float clear = kClearWeight * (sums.clear[i] + clear_all);
    const float w = sums.weight[i] + clear;
    const bool known = w >= least;
    value[i] = known ? (sums.distance[i] + clear * truncation) / w : truncation;
    weight[i] = known ? w : 0.0f;
    clear_throughout &= known && value[i] > 0.7f * truncation;
  }
  return clear_throughout;
}

int floor_div(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

Box RobustBox::box() {
  constexpr double kStray = 2e-4;
  Box box;
  if (values_[0].empty()) return box;
  for (int a = 0; a < 3; ++a) {
    auto& column = values_[std::size_t(a)];
    const auto cut = std::ptrdiff_t(kStray * double(column.size()));
    std::nth_element(column.begin(), column.begin() + cut, column.end());
    box.min[a] = column[std::size_t(cut)];
    std::nth_element(column.begin(), column.end() - 1 - cut, column.end());
    box.max[a] = *(column.end() - 1 - cut);
  }
  return box;
}

Vec3d FieldSums::sample_position(const Index& brick) const {
  return scale_.cell_m *
         Vec3d(double(brick[0]) * kSide, double(brick[1]) * kSide - 0.5, double(brick[2]) * kSide);
}

std::size_t FieldSums::super_index(const Index& s) const {
  return std::size_t(s[0] - low_[0]) +
         std::size_t(size_[0]) *
             (std::size_t(s[1] - low_[1]) + std::size_t(size_[1]) * std::size_t(s[2] - low_[2]));
}

/// Makes the table of bricks large enough for what the views measured. On a turning platter it is
/// round, so that it hardly grows.
Result<> FieldSums::cover(std::span<const DepthView> batch, const EarlierViews& before) {
  RobustBox points;
  for (const DepthView& view : batch) {
    for_each_point(view, [&](const Vec3f& p) {
      if (!scale_.cylinder || scale_.cylinder->contains(p.cast<double>())) points.add(p);
    });
  }
  Box box = points.box();
  if (box.empty()) return {};
  box.min.array() -= scale_.truncation_m + 2.0 * scale_.cell_m;
  box.max.array() += scale_.truncation_m + 2.0 * scale_.cell_m;
  if (scale_.cylinder) {
    if (scale_.floor_m) box.min.y() = -0.25 * scale_.cell_m;  // the lowest layer is at -0.5
    const double reach = std::max({-box.min.x(), box.max.x(), -box.min.z(), box.max.z()});
    box.min.x() = box.min.z() = -reach;
    box.max.x() = box.max.z() = reach;
  }
  Index low{}, high{};
  bool covered = !supers_.empty();
  double count = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    const double side = scale_.cell_m * kSide * kSuper;
    if (!(std::abs(box.min[int(a)]) + std::abs(box.max[int(a)]) < 1e6 * side)) count = 1e30;
    const double first = sample_position({0, 0, 0})[int(a)];
    low[a] = int(std::clamp(std::floor((box.min[int(a)] - first) / side), -1e6, 1e6));
    high[a] = int(std::clamp(std::floor((box.max[int(a)] - first) / side), -1e6, 1e6)) + 1;
    if (!supers_.empty()) {
      covered &= low[a] >= low_[a] && high[a] <= low_[a] + size_[a];
      low[a] = std::min(low[a], low_[a]);
      high[a] = std::max(high[a], low_[a] + size_[a]);
    }
    count *= high[a] - low[a];
  }
  if (covered) return {};
  if (!(count * double(kBricksOfSuper) < 2e7))
    return fail(ErrorCode::kResourceLimit,
                "volumetric: {:.0f} bricks of samples; choose a larger --voxel-size",
                count * double(kBricksOfSuper));
  const Index size{high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  std::vector<Super> supers(static_cast<std::size_t>(count));
  const auto at = [&](const Index& s) {
    return std::size_t(s[0] - low[0]) +
           std::size_t(size[0]) *
               (std::size_t(s[1] - low[1]) + std::size_t(size[1]) * std::size_t(s[2] - low[2]));
  };
  std::vector<std::uint8_t> old(supers.size(), 0);
  for (int k = 0; k < size_[2]; ++k) {
    for (int j = 0; j < size_[1]; ++j) {
      for (int i = 0; i < size_[0]; ++i) {
        const Index s{low_[0] + i, low_[1] + j, low_[2] + k};
        supers[at(s)] = std::move(supers_[super_index(s)]);
        old[at(s)] = 1;
      }
    }
  }
  supers_ = std::move(supers);
  low_ = low;
  size_ = size;
  parallel_for(supers_.size(), 4, [&](std::size_t n) {
    if (!old[n]) look_back(supers_[n], first_brick(n), before);
  });
  return {};
}

Volume::Index FieldSums::first_brick(std::size_t super) const {
  const auto nx = std::size_t(size_[0]), ny = std::size_t(size_[1]);
  return {kSuper * (low_[0] + int(super % nx)), kSuper * (low_[1] + int(super / nx % ny)),
          kSuper * (low_[2] + int(super / nx / ny))};
}

/// What earlier views saw of bricks that are new.
void FieldSums::look_back(Super& super, const Index& first, const EarlierViews& before) const {
  const auto truncation = float(scale_.truncation_m);
  const Vec3f center = ball_center(sample_position(first), kSide * kSuper, scale_.cell_m);
  for (const DepthView& kept : before.views) {
    const Sight sight =
        BallTest(kept, ball_radius(kSide * kSuper, scale_.cell_m), truncation)(center);
    if (sight == Sight::kClear) super.clear_all += before.weight;
    if (sight != Sight::kPartly && sight != Sight::kSurface) continue;
    const BallTest test(kept, ball_radius(kSide, scale_.cell_m), truncation);
    for (std::size_t b = 0; b < kBricksOfSuper; ++b) {
      const Vec3d low = sample_position(brick_in(first, b));
      if (test(ball_center(low, kSide, scale_.cell_m)) == Sight::kClear)
        super.clear[b] += before.weight;
    }
  }
}

/// What earlier views saw of a brick in which a surface is measured for the first time.
void FieldSums::look_back(detail::BrickSums& sums, const Vec3d& low,
                          const EarlierViews& before) const {
  const Vec3f center = ball_center(low, kSide, scale_.cell_m);
  const float origin[3] = {float(low.x()), float(low.y()), float(low.z())};
  for (const DepthView& kept : before.views) {
    const Sight sight =
        BallTest(kept, ball_radius(kSide, scale_.cell_m), float(scale_.truncation_m))(center);
    if (sight != Sight::kPartly && sight != Sight::kSurface) continue;
    detail::BrickSums own{};
    detail::add_view(kernel_of(kept), origin, float(scale_.cell_m), field_scale(scale_), own);
    for (std::size_t i = 0; i < kCells; ++i) sums.clear[i] += before.weight * own.clear[i];
  }
}

void FieldSums::add_to(Super& super, const Index& first, std::span<const DepthView> batch,
                       std::span<const detail::ViewKernel> kernels, const EarlierViews& before) {
  const auto truncation = float(scale_.truncation_m);
  const float small = ball_radius(kSide, scale_.cell_m);
  const Vec3f center = ball_center(sample_position(first), kSide * kSuper, scale_.cell_m);
  std::vector<std::size_t> mixed;
  for (std::size_t v = 0; v < batch.size(); ++v) {
    const Sight sight =
        BallTest(batch[v], ball_radius(kSide * kSuper, scale_.cell_m), truncation)(center);
    if (sight == Sight::kClear) super.clear_all += 1.0f;
    if (sight == Sight::kPartly || sight == Sight::kSurface) mixed.push_back(v);
  }
  if (mixed.empty()) return;
  for (std::size_t b = 0; b < kBricksOfSuper; ++b) {
    const Vec3d low = sample_position(brick_in(first, b));
    const Vec3f middle = ball_center(low, kSide, scale_.cell_m);
    const float origin[3] = {float(low.x()), float(low.y()), float(low.z())};
    auto& sums = super.sums[b];
    std::vector<std::size_t> partly;  // of this batch, before there were sums
    for (const std::size_t v : mixed) {
      const Sight sight = BallTest(batch[v], small, truncation)(middle);
      if (sight == Sight::kClear) super.clear[b] += 1.0f;
      if (sight == Sight::kPartly && !sums) partly.push_back(v);
      if (sight != Sight::kSurface && (sight != Sight::kPartly || !sums)) continue;
      if (sums) {
        detail::add_view(kernels[v], origin, float(scale_.cell_m), field_scale(scale_), *sums);
        continue;
      }
      detail::BrickSums own{};
      detail::add_view(kernels[v], origin, float(scale_.cell_m), field_scale(scale_), own);
      if (!measured_any(own)) {
        partly.push_back(v);
        continue;
      }
      sums = std::make_unique<detail::BrickSums>(own);
      for (const std::size_t u : partly)
        detail::add_view(kernels[u], origin, float(scale_.cell_m), field_scale(scale_), *sums);
      look_back(*sums, low, before);
    }
  }
}

Result<> FieldSums::add(std::span<const DepthView> batch, const EarlierViews& before) {
  TURNSCAN_TRY(cover(batch, before));
  std::vector<detail::ViewKernel> kernels;
  for (const DepthView& view : batch) kernels.push_back(kernel_of(view));
  std::atomic<std::size_t> bricks{0};
  parallel_for(supers_.size(), 1, [&](std::size_t n) {
    if (bricks * sizeof(detail::BrickSums) > 2 * scale_.max_bytes) return;  // ends in an error
    add_to(supers_[n], first_brick(n), batch, kernels, before);
    bricks += std::size_t(std::count_if(supers_[n].sums.begin(), supers_[n].sums.end(),
                                        [](const auto& s) { return s != nullptr; }));
  });
  bytes_ = bricks * sizeof(detail::BrickSums);
  if (bytes_ > scale_.max_bytes)
    return fail(ErrorCode::kResourceLimit,
                "volumetric: the samples need more than {} MB; choose a larger --voxel-size",
                scale_.max_bytes >> 20);
  return {};
}

FieldSums::BrickView FieldSums::brick(const Index& at) const {
  Index super{};
  std::size_t in = 0;
  for (std::size_t a = 3; a-- > 0;) {
    super[a] = floor_div(at[a], kSuper);
    if (super[a] < low_[a] || super[a] >= low_[a] + size_[a]) return {};
    in = kSuper * in + std::size_t(at[a] - kSuper * super[a]);
  }
  const Super& s = supers_[super_index(super)];
  return {s.sums[in].get(), s.clear[in] + s.clear_all};
}

/// With less, a sample counts as not seen.
float FieldSums::least_weight() const {
  std::vector<const detail::BrickSums*> all;
  for (const Super& super : supers_) {
    for (const auto& sums : super.sums) {
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
    const BrickView own = brick(at);
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
  for (std::size_t n = 0; n < supers_.size(); ++n) {
    const Index first = first_brick(n);
    for (std::size_t b = 0; b < kBricksOfSuper; ++b) {
      if (!supers_[n].sums[b]) continue;
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
    const BrickView own = brick({at[0] + offset[0], at[1] + offset[1], at[2] + offset[2]});
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
