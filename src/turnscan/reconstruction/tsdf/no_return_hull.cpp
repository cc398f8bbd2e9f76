#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/reconstruction/tsdf/no_return_hull.hpp>
#include <turnscan/reconstruction/views/no_return.hpp>

namespace turnscan::tsdf {

namespace {

constexpr std::size_t kMaxViews = 128;
constexpr int kMinNoReturnViews = 3;   ///< views that observed a sample without a return
constexpr float kMinShare = 0.4f;      ///< of the views that observed it or were occluded from it
constexpr int kSeenPast = 2;           ///< this many views make a sample free
constexpr std::size_t kMinPart = 216;  ///< samples; smaller parts are dropped

constexpr int kWidestRim = 3;  ///< pixels: maximum median for sensors with negligible shadows

/// Whether pixels without a return are usually due to surface that returns nothing, rather than to
/// shadows.
bool rims_are_narrow(const std::vector<std::vector<int>>& widths) {
  std::vector<int> all;
  for (const auto& own : widths) all.insert(all.end(), own.begin(), own.end());
  if (all.empty()) return false;
  const auto middle = all.begin() + std::ptrdiff_t(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle <= kWidestRim;
}

/// A view with no-return pixels, and their number in the rectangle starting at the image's first
/// pixel.
struct NoReturnView {
  const views::DepthView* view;
  Image<std::uint8_t> no_return;
  Image<std::uint32_t> sums;

  NoReturnView(const views::DepthView& v, Image<std::uint8_t> mask)
      : view(&v), no_return(std::move(mask)), sums(v.width + 1, v.height + 1, 0) {
    for (int y = 0; y < v.height; ++y) {
      std::uint32_t row = 0;
      for (int x = 0; x < v.width; ++x) {
        row += no_return.at(x, y);
        sums.at(x + 1, y + 1) = sums.at(x + 1, y) + row;
      }
    }
  }

  /// Whether a ball in front of the sensor may project onto a no-return pixel.
  bool shows(const Vec3f& p_table, float radius_m) const {
    const Vec3f p = view->rotation * p_table + view->translation;
    if (!(p.z() > 2.0f * radius_m)) return false;
    const Eigen::Vector2f at = view->project(p);
    const float reach = std::max(view->fx, view->fy) * radius_m / (p.z() - radius_m) + 1.0f;
    const auto within = [](float value, int size) {
      return int(std::clamp(value, 0.0f, float(size)));
    };
    const int x0 = within(at.x() - reach, view->width), y0 = within(at.y() - reach, view->height);
    const int x1 = within(at.x() + reach + 1.0f, view->width);
    const int y1 = within(at.y() + reach + 1.0f, view->height);
    return sums.at(x1, y1) - sums.at(x0, y1) - sums.at(x1, y0) + sums.at(x0, y0) > 0;
  }
};

/// The views' votes on a sample.
struct Votes {
  int past = 0, no_return = 0, hidden = 0;

  void add(const NoReturnView& v, const Vec3f& p_table, float tolerance_m) {
    const views::DepthView& view = *v.view;
    const Vec3f p = view.rotation * p_table + view.translation;
    const std::ptrdiff_t at = view.pixel_at(p);
    if (at < 0) return;
    const std::uint32_t word = view.pixels[std::size_t(at)];
    if (v.no_return.pixels[std::size_t(at)] != 0) {
      ++no_return;
    } else if (word != 0) {
      const auto depth = [&](std::uint32_t raw) { return float(raw) * view.unit_m + view.bias_m; };
      if (depth(word >> 17 << 1) > p.z() + tolerance_m)
        ++past;
      else
        ++hidden;
    }
  }
  bool free() const { return past >= kSeenPast; }
  bool hull() const {
    return !free() && no_return >= kMinNoReturnViews &&
           float(no_return) >= kMinShare * float(no_return + hidden);
  }
};

class HullFinder {
 public:
  HullFinder(Volume& volume, std::vector<NoReturnView> views)
      : v_(volume), views_(std::move(views)), unknown_(unseen_samples(volume)) {}

  Result<SampleBits> run(const RunContext& context) {
    SampleBits hull(v_.bricks), free(v_.bricks);
    TURNSCAN_TRY(parallel_for(v_.brick_count(), 8, context,
                              [&](std::size_t b) { look_at(b, hull.brick(b), free.brick(b)); }));
    enter_free(free);
    drop_crumbs(hull);
    return hull;
  }

 private:
  void look_at(std::size_t b, BrickBits& hull, BrickBits& free) const {
    const BrickBits& unknown = unknown_.brick(b);
    if (std::all_of(unknown.begin(), unknown.end(), [](auto layer) { return layer == 0; })) return;
    const GridCoords at = v_.bricks.coords(b);
    const Vec3d first = v_.position(at[0] * kBrickSide, at[1] * kBrickSide, at[2] * kBrickSide);
    const double half = 0.5 * (kBrickSide - 1) * v_.cell_m;
    const Vec3f middle = (first.array() + half).cast<float>();
    const float radius = float(1.75 * half);  // of the surrounding ball
    const auto showing = std::count_if(views_.begin(), views_.end(), [&](const NoReturnView& view) {
      return view.shows(middle, radius);
    });
    if (showing < kMinNoReturnViews) return;
    for (std::size_t c = 0; c < kBrickSamples; ++c) {
      if (!contains(unknown, c)) continue;
      const Vec3d offset(double(c & 7), double(c >> 3 & 7), double(c >> 6));
      const Vec3f p = (first + v_.cell_m * offset).cast<float>();
      Votes votes;
      for (const NoReturnView& view : views_) votes.add(view, p, float(v_.truncation_m));
      if (votes.free()) insert(c, free);
      if (votes.hull()) insert(c, hull);
    }
  }

  void enter_free(const SampleBits& free) {
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      const BrickBits& bits = free.brick(b);
      if (std::all_of(bits.begin(), bits.end(), [](auto layer) { return layer == 0; })) continue;
      if (v_.slot[b] < 0) v_.allocate(b, float(v_.truncation_m));
      for (std::size_t c = 0; c < kBrickSamples; ++c) {
        if (!contains(bits, c)) continue;
        v_.value[v_.first_sample(b) + c] = float(v_.truncation_m);
        v_.weight[v_.first_sample(b) + c] = 1.0f;
      }
    }
  }

  /// Removes parts, connected along the axes, of few samples.
  void drop_crumbs(SampleBits& hull) const {
    SampleBits left = hull;
    const auto at = [](std::size_t b, std::size_t c) { return b * kBrickSamples + c; };
    std::vector<std::size_t> part;
    const auto take = [&](std::size_t b, std::size_t c) {
      BrickBits& bits = left.brick(b);
      if (!contains(bits, c)) return;
      bits[c >> 6] &= ~(std::uint64_t(1) << (c & 63));
      part.push_back(at(b, c));
    };
    for (std::size_t b = 0; b < v_.brick_count(); ++b) {
      for (std::size_t c = 0; c < kBrickSamples; ++c) {
        part.clear();
        take(b, c);
        for (std::size_t i = 0; i < part.size(); ++i) visit_neighbours(part[i], take);
        if (part.size() >= kMinPart) continue;
        for (const std::size_t s : part) {
          const std::size_t sample = s % kBrickSamples;
          hull.brick(s / kBrickSamples)[sample >> 6] &= ~(std::uint64_t(1) << (sample & 63));
        }
      }
    }
  }

  template <class Visit>
  void visit_neighbours(std::size_t at, const Visit& visit) const {
    const GridCoords brick = v_.bricks.coords(at / kBrickSamples);
    const std::size_t c = at % kBrickSamples;
    const GridCoords sample{brick[0] * kBrickSide + int(c & 7),
                            brick[1] * kBrickSide + int(c >> 3 & 7),
                            brick[2] * kBrickSide + int(c >> 6)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        GridCoords next = sample;
        next[axis] += side;
        if (next[axis] < 0) continue;
        const GridCoords in{next[0] >> 3, next[1] >> 3, next[2] >> 3};
        if (v_.bricks.contains(in))
          visit(v_.bricks.at(in), sample_in_brick(next[0], next[1], next[2]));
      }
    }
  }

  Volume& v_;
  const std::vector<NoReturnView> views_;
  const SampleBits unknown_;
};

}  // namespace

Result<SampleBits> no_return_hull(Volume& volume, std::span<const views::DepthView> views,
                                  const RunContext& context) {
  const auto chosen = evenly_spread(views.size(), kMaxViews);
  std::vector<Image<std::uint8_t>> masks(chosen.size());
  std::vector<std::vector<int>> rims(chosen.size());
  TURNSCAN_TRY(parallel_for(chosen.size(), 4, context, [&](std::size_t i) {
    masks[i] = views::enclosed_no_return(views[chosen[i]]);
    rims[i] = views::rim_widths(views[chosen[i]]);
  }));
  const auto no_return =
      std::count_if(masks.begin(), masks.end(), [](const auto& mask) { return !mask.empty(); });
  if (no_return < kMinNoReturnViews || !rims_are_narrow(rims)) return SampleBits(volume.bricks);
  std::vector<NoReturnView> asked;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const views::DepthView& view = views[chosen[i]];
    Image<std::uint8_t> none(view.width, view.height, 0);
    asked.emplace_back(view, masks[i].empty() ? std::move(none) : std::move(masks[i]));
  }
  return HullFinder(volume, std::move(asked)).run(context);
}

void set_inside(Volume& volume, const SampleBits& samples) {
  for (std::size_t b = 0; b < volume.brick_count(); ++b) {
    const BrickBits& bits = samples.brick(b);
    if (std::all_of(bits.begin(), bits.end(), [](auto layer) { return layer == 0; })) continue;
    if (volume.slot[b] < 0) volume.allocate(b, volume.uniform[b] * float(volume.truncation_m));
    for (std::size_t c = 0; c < kBrickSamples; ++c) {
      if (!contains(bits, c)) continue;
      volume.value[volume.first_sample(b) + c] = -float(volume.truncation_m);
      volume.weight[volume.first_sample(b) + c] = 1e-6f;
    }
  }
}

}  // namespace turnscan::tsdf
