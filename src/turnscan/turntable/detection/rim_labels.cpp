#include <algorithm>
#include <turnscan/turntable/detection/rim_labels.hpp>

namespace turnscan::detection {

namespace {

enum class Seen : std::uint8_t { kUnknown, kPlatter, kFlickers, kBehind, kNothing, kBefore };

constexpr double kInwards_px = 7.0;  // from the outermost relevant pixels into the platter
constexpr int kCrowdReach = 2, kBareReach = 3;  // pixels
constexpr int kMaxInCrowd = 12;                 // flickering ones, of 25: an edge has up to 10

class RimLabelling {
 public:
  RimLabelling(const PlaneView& view, const RimView& rays, const RimModel& model,
               const NoiseCorrelation& noise, double slack_m)
      : view_(view),
        rays_(rays),
        model_(model),
        noise_(noise),
        slack_m_(slack_m),
        w_(view.scan.width),
        h_(view.scan.height),
        middle_(view.camera.project(view.frame.to_space(model.center))),
        seen_(view.scan.point.size(), Seen::kUnknown) {}

  std::vector<RimPixel> run(double reach_px, const RunContext& context) {
    std::vector<std::size_t> band;
    const PixelBox box = rays_.box(model_, int(reach_px) + 5);
    for (int y = box.top; y < box.bottom; ++y) {
      if (context.cancelled()) return {};
      for (int x = box.left; x < box.right; ++x) {
        const auto d = rays_.outline(model_, x, y);
        if (!d || d->px < -reach_px - 3.0) continue;
        const auto disc = rays_.disc_px(model_, x, y);
        if (d->px > reach_px + 3.0 && (!disc || *disc > reach_px + 3.0)) continue;
        seen_[index(x, y)] = look(x, y);
        if (d->px > -reach_px && (d->px < reach_px || *disc < reach_px))
          band.push_back(index(x, y));
      }
    }
    std::vector<RimPixel> out;
    for (const std::size_t i : band) {
      const int x = int(i % std::size_t(w_)), y = int(i / std::size_t(w_));
      if (const auto label = label_of(x, y))
        out.push_back({x, y, *label, double(view_.scan.point[i].z())});
    }
    mark_bare(out);
    return out;
  }

 private:
  std::size_t index(int x, int y) const {
    return std::size_t(y) * std::size_t(w_) + std::size_t(x);
  }

  /// The background determines whether its mixture with the platter has a return, and thus on which
  /// side of the outline the mixture begins.
  void mark_bare(std::vector<RimPixel>& pixels) const {
    std::vector<std::int8_t> emptier(seen_.size(), 0);
    for (const RimPixel& p : pixels) {
      if (p.label == RimLabel::kEmpty) emptier[index(p.column, p.row)] = 1;
      if (p.label == RimLabel::kMixed) emptier[index(p.column, p.row)] = -1;
    }
    for (RimPixel& p : pixels) {
      int sum = 0;
      for (int v = std::max(0, p.row - kBareReach); v <= std::min(h_ - 1, p.row + kBareReach); ++v)
        for (int u = std::max(0, p.column - kBareReach);
             u <= std::min(w_ - 1, p.column + kBareReach); ++u)
          sum += emptier[index(u, v)];
      p.bare = sum > 0;
    }
  }

  Seen look(int x, int y) const {
    const std::size_t i = index(x, y);
    const double z = view_.scan.point[i].z();
    const auto surface = rays_.surface(model_, x, y);
    if (!surface) return Seen::kUnknown;
    if (!(z > 0.0)) return surface->z_m < view_.scan.nearest_m ? Seen::kUnknown : Seen::kNothing;
    const double behind = z - surface->z_m;
    const double tolerance =
        0.002 + 4.0 * noise_.sigma_m + 0.75 * surface->slant_m + (surface->wall ? slack_m_ : 0.0);
    if (behind < -tolerance) return Seen::kBefore;
    if (!view_.scan.still[i] && !as_noisy_as_far(z, surface->z_m, i)) return Seen::kFlickers;
    return behind > tolerance ? Seen::kBehind : Seen::kPlatter;
  }

  /// Noise that grows with the square of the distance does not count as flicker.
  bool as_noisy_as_far(double z, double z_platter, std::size_t i) const {
    const double farther = z / z_platter;
    return farther > 1.2 &&
           view_.scan.deviation_m[i] < view_.scan.still_limit_m * farther * farther;
  }

  template <class Test>
  bool any_near(int x, int y, int reach, const Test& test) const {
    for (int v = std::max(0, y - reach); v <= std::min(h_ - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(w_ - 1, x + reach); ++u)
        if (test(seen_[index(u, v)])) return true;
    return false;
  }

  /// What moves in front of platter and background flickers everywhere.
  bool in_crowd(int x, int y) const {
    int count = 0;
    any_near(x, y, kCrowdReach, [&](Seen s) { return (count += s == Seen::kFlickers), false; });
    return count > kMaxInCrowd;
  }

  /// Whether a pixel behind the platter is between it and the background beside, as a filter mixes
  /// them.
  bool between(int x, int y) const {
    const auto surface = rays_.surface(model_, x, y);
    if (!surface) return false;
    const int reach = 1 + noise_.blur_px;
    double farthest = 0.0;
    for (int v = std::max(0, y - reach); v <= std::min(h_ - 1, y + reach); ++v) {
      for (int u = std::max(0, x - reach); u <= std::min(w_ - 1, x + reach); ++u)
        if (seen_[index(u, v)] == Seen::kBehind)
          farthest = std::max(farthest, double(view_.scan.point[index(u, v)].z()));
    }
    const double z = view_.scan.point[index(x, y)].z();
    const double smooth = 1.5 * reach * surface->slant_m + 6.0 * noise_.sigma_m + 0.002;
    return farthest - z > std::max(smooth, 0.15 * (farthest - surface->z_m));
  }

  /// If nothing is seen on the inner side either, the platter there may be in the object's shadow
  /// from the sensor's lamp.
  bool inside_is_seen(int x, int y) const {
    const Eigen::Vector2d here(x, y);
    const Eigen::Vector2d way = middle_ - here;
    const double step = std::min(way.norm(), kInwards_px);
    const Eigen::Vector2d there = here + step * way.normalized();
    const int u = int(std::lround(there.x())), v = int(std::lround(there.y()));
    if (u < 0 || v < 0 || u >= w_ || v >= h_) return false;
    const Seen inside = look(u, v);
    return inside == Seen::kPlatter || inside == Seen::kFlickers;
  }

  std::optional<RimLabel> label_of(int x, int y) const {
    const auto before = [](Seen s) { return s == Seen::kBefore; };
    if (any_near(x, y, 1 + noise_.blur_px, before) || in_crowd(x, y)) return std::nullopt;
    switch (seen_[index(x, y)]) {
      case Seen::kPlatter:
        return RimLabel::kPlatter;
      case Seen::kFlickers:
        return RimLabel::kMixed;
      case Seen::kBehind:
        return between(x, y) ? RimLabel::kMixed : RimLabel::kBackground;
      case Seen::kNothing:
        return inside_is_seen(x, y) ? std::optional(RimLabel::kEmpty) : std::nullopt;
      default:
        return std::nullopt;
    }
  }

  const PlaneView& view_;
  const RimView& rays_;
  const RimModel& model_;
  const NoiseCorrelation& noise_;
  double slack_m_;
  int w_, h_;
  Eigen::Vector2d middle_;  ///< of the disc, in the image
  std::vector<Seen> seen_;
};

}  // namespace

std::vector<RimPixel> label_rim(const PlaneView& view, const RimView& rays, const RimModel& model,
                                const NoiseCorrelation& noise, double reach_px, double slack_m,
                                const RunContext& context) {
  return RimLabelling(view, rays, model, noise, slack_m).run(reach_px, context);
}

}  // namespace turnscan::detection
