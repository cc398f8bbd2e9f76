#include <algorithm>
#include <array>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/reconstruction/tsdf/mixed_pixel_surface.hpp>

namespace turnscan::tsdf {

namespace {

constexpr std::size_t kViewsAsked = 256;
/// Samples are doubtful below this share of the typical weight beside a surface, minus the number
/// of measurements that chance does not produce: with few frames none is.
constexpr float kDoubtedShare = 0.05f, kUndoubted = 3.0f;
constexpr float kStepTruncations = 2;     ///< of a depth step
constexpr float kDoubtedDistance = 0.9f;  ///< of the truncation distance: samples farther away are
                                          ///< free

float weight_beside_surface(const Volume& volume) {
  std::vector<float> weights;
  for (std::size_t s = 0; s < volume.value.size(); s += 7)
    if (volume.weight[s] > 0.0f && std::abs(volume.value[s]) < float(volume.cell_m))
      weights.push_back(volume.weight[s]);
  return typical_weight(weights);
}

class Doubts {
 public:
  Doubts(std::span<const views::DepthView> views, float truncation_m)
      : truncation_m_(truncation_m) {
    for (const std::size_t i : evenly_spread(views.size(), kViewsAsked))
      views_.push_back(&views[i]);
  }

  /// Whether no view measured a surface there except beside a step.
  bool hold(const Vec3f& p_table) const {
    return std::none_of(views_.begin(), views_.end(), [&](const views::DepthView* view) {
      const Vec3f p = view->rotation * p_table + view->translation;
      const std::ptrdiff_t at = view->pixel_at(p);
      if (at < 0) return false;
      const auto depth = depth_at(*view, at);
      return depth && std::abs(*depth - p.z()) < truncation_m_ && !beside_step(*view, at, *depth);
    });
  }

 private:
  static std::optional<float> depth_at(const views::DepthView& view, std::ptrdiff_t at) {
    const std::uint32_t raw = view.pixels[std::size_t(at)] & 0xffffu;
    if (raw == 0) return std::nullopt;
    return float(raw) * view.unit_m + view.bias_m;
  }

  /// A view has an empty border, so a pixel with a measurement has neighbours.
  bool beside_step(const views::DepthView& view, std::ptrdiff_t at, float depth) const {
    const std::array<std::ptrdiff_t, 4> sides{-1, 1, -view.width, view.width};
    return std::any_of(sides.begin(), sides.end(), [&](std::ptrdiff_t side) {
      const auto other = depth_at(view, at + side);
      return other && std::abs(*other - depth) > kStepTruncations * truncation_m_;
    });
  }

  std::vector<const views::DepthView*> views_;
  float truncation_m_;
};

}  // namespace

Result<> forget_doubtful_surface(Volume& volume, std::span<const views::DepthView> views,
                                 const RunContext& context) {
  const auto truncation = float(volume.truncation_m);
  const Doubts doubts(views, truncation);
  const float few = kDoubtedShare * weight_beside_surface(volume) - kUndoubted;
  const std::vector<std::size_t> bricks = volume.allocated_bricks();
  return parallel_for(bricks.size(), 4, context, [&](std::size_t i) {
    const GridCoords at = volume.bricks.coords(bricks[i]);
    const std::size_t first = volume.first_sample(bricks[i]);
    for (std::size_t c = 0; c < kBrickSamples; ++c) {
      float &value = volume.value[first + c], &weight = volume.weight[first + c];
      if (!(weight > 0.0f) || weight > few || value > kDoubtedDistance * truncation) continue;
      const Vec3d p =
          volume.position(at[0] * kBrickSide + int(c & 7), at[1] * kBrickSide + int(c >> 3 & 7),
                          at[2] * kBrickSide + int(c >> 6));
      if (!doubts.hold(p.cast<float>())) continue;
      value = truncation;
      weight = 0.0f;
    }
  });
}

}  // namespace turnscan::tsdf
