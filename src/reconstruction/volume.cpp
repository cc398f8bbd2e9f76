#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/volume.hpp>

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

enum class Sight { kNothing, kClear, kMixed };

/// What a view can say about a ball, from its tiles.
class BallTest {
 public:
  BallTest(const DepthView& view, float radius_m, float truncation_m)
      : view_(view), radius_(radius_m), truncation_(truncation_m) {}

  Sight operator()(const Vec3f& center_table) const {
    const Vec3f c = view_.rotation * center_table + view_.translation;
    const float z = view_.parallel ? 1.0f : c.z();
    if (!view_.parallel && c.z() < 2.0f * radius_) return Sight::kNothing;
    // Distortion of the lens across the ball is within the widened radius.
    float x = c.x() / z, y = c.y() / z;
    if (view_.distorted) distort(x, y);
    const float u = x * view_.fx + view_.cx, v = y * view_.fy + view_.cy;
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
  void distort(float& x, float& y) const {
    const auto& k = view_.distortion;
    const float r2 = x * x + y * y, radial = 1.0f + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    const float a = x * radial + 2.0f * k[2] * x * y + k[3] * (r2 + 2.0f * x * x);
    y = y * radial + k[2] * (r2 + 2.0f * y * y) + 2.0f * k[3] * x * y;
    x = a;
  }

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
    if (surface) return Sight::kMixed;
    if (t.clear > 0 && metres(t.clear) > back) return Sight::kClear;
    if (t.clear_most > 0 && metres(t.clear_most) > front) return Sight::kMixed;
    return Sight::kNothing;
  }

  const DepthView& view_;
  float radius_, truncation_;
};

/// Everything that the views say about one brick.
struct BrickResult {
  std::unique_ptr<detail::BrickSums> sums;
  float clear = 0.0f;  ///< views that saw past the whole brick
};

class Accumulator {
 public:
  Accumulator(std::span<const DepthView> views, const VolumeScale& scale, const Volume& volume)
      : views_(views), volume_(volume) {
    scale_ = {float(scale.truncation_m), float(scale.behind_m), scale.edge_weight};
    radius_ = float(0.5 * std::sqrt(3.0) * kSide * scale.cell_m);
    kernels_.reserve(views.size());
    for (const DepthView& view : views) kernels_.push_back(kernel_of(view));
  }

  BrickResult operator()(std::size_t brick) const {
    const Index b = volume_.brick_at(brick);
    const Vec3d low = volume_.position(b[0] * kSide, b[1] * kSide, b[2] * kSide);
    const double half = 0.5 * (kSide - 1) * volume_.cell_m;
    const Vec3f center = (low.array() + half).matrix().cast<float>();
    const float origin[3] = {float(low.x()), float(low.y()), float(low.z())};
    BrickResult out;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const Sight sight = BallTest(views_[v], radius_, scale_.truncation)(center);
      if (sight == Sight::kClear) out.clear += 1.0f;
      if (sight != Sight::kMixed) continue;
      if (!out.sums) out.sums = std::make_unique<detail::BrickSums>();
      detail::add_view(kernels_[v], origin, float(volume_.cell_m), scale_, *out.sums);
    }
    drop_if_empty(out);
    return out;
  }

 private:
  /// Where nothing was measured, the least clear sample stands for all.
  static void drop_if_empty(BrickResult& r) {
    if (!r.sums) return;
    const auto& sums = *r.sums;
    if (std::any_of(sums.weight, sums.weight + kCells, [](float w) { return w > 0.0f; })) return;
    r.clear += *std::min_element(sums.clear, sums.clear + kCells);
    r.sums.reset();
  }

  std::span<const DepthView> views_;
  const Volume& volume_;
  detail::FieldScale scale_{};
  float radius_ = 0.0f;
  std::vector<detail::ViewKernel> kernels_;
};

/// Typical weight of a sample beside a surface: the median.
float typical_weight(const std::vector<BrickResult>& results, float cell) {
  std::vector<float> weights;
  for (const BrickResult& r : results) {
    if (!r.sums) continue;
    for (std::size_t i = 0; i < kCells; i += 7) {
      const float w = r.sums->weight[i];
      if (w > 0.0f && std::abs(r.sums->distance[i]) < w * cell) weights.push_back(w);
    }
  }
  if (weights.empty()) return 0.0f;
  const auto middle = weights.begin() + std::ptrdiff_t(weights.size() / 2);
  std::nth_element(weights.begin(), middle, weights.end());
  return *middle;
}

/// From sums to distances. Returns whether all samples are clear for sure.
bool settle(const BrickResult& r, float truncation, float least, float* value, float* weight) {
  bool clear_throughout = true;
  for (std::size_t i = 0; i < kCells; ++i) {
    const float clear = kClearWeight * (r.sums->clear[i] + r.clear);
    const float w = r.sums->weight[i] + clear;
    const bool known = w >= least;
    value[i] = known ? (r.sums->distance[i] + clear * truncation) / w : truncation;
    weight[i] = known ? w : 0.0f;
    clear_throughout &= known && value[i] > 0.7f * truncation;
  }
  return clear_throughout;
}

}  // namespace

void Volume::touch(std::size_t brick, float start) {
  slot[brick] = std::int32_t(slots());
  value.insert(value.end(), kCells, start);
  weight.insert(weight.end(), kCells, 0.0f);
}

detail::ViewKernel kernel_of(const DepthView& view) {
  detail::ViewKernel k{};
  k.pixels = view.pixels.data();
  k.width = view.width;
  k.height = view.height;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      k.rotation[row * 3 + column] = view.rotation(row, column);
    k.translation[row] = view.translation[row];
  }
  k.fx = view.fx, k.fy = view.fy, k.cx = view.cx, k.cy = view.cy;
  k.k1 = view.distortion[0], k.k2 = view.distortion[1], k.p1 = view.distortion[2];
  k.p2 = view.distortion[3], k.k3 = view.distortion[4];
  k.unit = view.unit_m, k.bias = view.bias_m;
  k.distorted = view.distorted ? 1 : 0;
  k.parallel = view.parallel ? 1 : 0;
  return k;
}

Result<Volume> accumulate(std::span<const DepthView> views, const Box& box,
                          const VolumeScale& scale, const RunContext& context) {
  Volume volume;
  volume.cell_m = scale.cell_m;
  volume.truncation_m = scale.truncation_m;
  const double brick_m = scale.cell_m * kSide;
  double count = 1.0;
  for (int a = 0; a < 3; ++a) {
    const double low = std::floor(box.min[a] / scale.cell_m);
    // The platter, y = 0, lies halfway between two layers of samples.
    volume.origin_m[a] = (low + (a == 1 ? 0.5 : 0.0)) * scale.cell_m;
    volume.bricks[std::size_t(a)] =
        std::max(1, int(std::ceil((box.max[a] - volume.origin_m[a]) / brick_m)));
    count *= volume.bricks[std::size_t(a)];
  }
  if (!(count < 2e7))
    return fail(ErrorCode::kResourceLimit,
                "volumetric: {:.0f} bricks of samples; choose a larger --voxel-size", count);
  volume.slot.assign(std::size_t(count), -1);
  volume.uniform.assign(std::size_t(count), 0.0f);
  context.begin_phase("distances", volume.brick_count());
  std::vector<BrickResult> results(volume.brick_count());
  const Accumulator accumulator(views, scale, volume);
  std::atomic<std::size_t> bytes{0};
  parallel_for(volume.brick_count(), 8, [&](std::size_t b) {
    if (context.cancelled() || bytes > scale.max_bytes) return;
    results[b] = accumulator(b);
    if (results[b].sums) bytes += sizeof(detail::BrickSums);
    context.advance();
  });
  TURNSCAN_TRY(context.check());
  if (bytes > scale.max_bytes)
    return fail(ErrorCode::kResourceLimit,
                "volumetric: the samples need more than {} MB; choose a larger --voxel-size",
                scale.max_bytes >> 20);
  const float truncation = float(scale.truncation_m);
  const float least =
      std::max(kLeastWeight, kLeastShare * typical_weight(results, float(scale.cell_m)));
  std::vector<float> value(kCells), weight(kCells);
  for (std::size_t b = 0; b < results.size(); ++b) {
    BrickResult& r = results[b];
    if (!r.sums) {
      volume.uniform[b] = kClearWeight * r.clear >= least ? 1.0f : 0.0f;
      continue;
    }
    if (settle(r, truncation, least, value.data(), weight.data())) {
      volume.uniform[b] = 1.0f;
    } else if (std::any_of(weight.begin(), weight.end(), [](float w) { return w > 0.0f; })) {
      volume.touch(b, truncation);
      std::copy(value.begin(), value.end(), volume.value.end() - std::ptrdiff_t(kCells));
      std::copy(weight.begin(), weight.end(), volume.weight.end() - std::ptrdiff_t(kCells));
    }
    r.sums.reset();
  }
  return volume;
}

Result<BrickGrid> to_grid(const Volume& volume, std::size_t max_bytes) {
  TURNSCAN_ASSIGN(BrickGrid grid,
                  BrickGrid::create(volume.origin_m, volume.cell_m,
                                    {volume.bricks[0] * kSide, volume.bricks[1] * kSide,
                                     volume.bricks[2] * kSide},
                                    1.0f, max_bytes));
  std::vector<std::size_t> touched;
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    if (volume.slot[b] >= 0)
      touched.push_back(b);
    else
      grid.uniform(b) = float(volume.uniform[b] * volume.truncation_m);
  }
  TURNSCAN_TRY(grid.touch(touched));
  for (const std::size_t b : touched) {
    const float* from = &volume.value[std::size_t(volume.slot[b]) * kCells];
    std::copy(from, from + kCells, grid.samples(b));
  }
  return grid;
}

}  // namespace turnscan
