#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/reconstruction/tsdf/volumetric.hpp>

namespace turnscan::tsdf {

namespace {

/// With this many views, or if more may come, the default scales suffice.
constexpr std::size_t kFewViews = 24;

bool few_views(const VolumetricInput& input) {
  return !input.profiles && input.views.size() < kFewViews;
}

/// If few views face the surface, only the samples' size averages the noise. Over a disc of radius
/// r it falls as 1 / r, and the error on a surface with radius of curvature R grows as r^2 / 8 R:
/// they balance at r^3 = 4 R noise spacing / sqrt(pi views).
double balance(const VolumetricInput& input, double facing, double bend_m) {
  // A few views may all be misplaced in the same way.
  const double independent = std::max(1.0, facing - 3.0);
  return std::cbrt(4.0 * bend_m * input.noise_m * input.spacing_m /
                   std::sqrt(std::numbers::pi * independent));
}

/// A larger voxel size for few views, with the reason.
void widen_for_few(const VolumetricInput& input, double longest, double& cell,
                   std::string& reason) {
  if (!few_views(input)) return;
  // About a third of them face a point.
  const double facing = std::max(1.0, double(input.views.size()) / 3.0);
  const double gaps = std::min(input.spacing_m, 1.6 * input.spacing_m / std::sqrt(facing));
  if (cell < gaps) {
    cell = gaps;
    reason = fmt::format("the spacing of a frame's points, {}, in {} frames",
                         length_text(input.spacing_m), input.views.size());
  }
  const double bend = longest / 16.0, radius = balance(input, facing, bend);
  if (cell < 0.5 * radius) {
    cell = 0.5 * radius;
    reason = fmt::format(
        "half of {}, at which noise of {} and curvature of radius {} cause equal errors",
        length_text(radius), length_text(input.noise_m), length_text(bend));
  }
}

/// A surface that some views see past keeps an inside if the truncation distance is this much
/// larger than the violation; samples much finer than that resolve no more.
constexpr double kDeeperThanSeenPast = 1.5, kSeenPastPerCell = 8.0;
/// With a larger share of the longest side it would swallow the object.
constexpr double kDeepest = 1.0 / 12.0;

}  // namespace

VolumetricScale choose_scale(const VolumetricInput& input, const VolumetricOptions& options,
                             const Box& box) {
  VolumetricScale out;
  VolumeScale& scale = out.volume;
  const auto choose = [&](const char* option, const std::optional<double>& given, double automatic,
                          const std::string& reason) {
    const double value = given.value_or(automatic);
    out.choices.push_back({option, length_text(value), given ? "given" : reason});
    return value;
  };
  const double longest = box.size().maxCoeff();
  double cell = input.cells_of_spacing * input.spacing_m;
  std::string reason = fmt::format("{:g} of the spacing of a frame's points, {}",
                                   input.cells_of_spacing, length_text(input.spacing_m));
  if (cell < 0.5 * input.noise_m) {
    cell = 0.5 * input.noise_m;
    reason = fmt::format("half the noise, {}", length_text(input.noise_m));
  }
  widen_for_few(input, longest, cell, reason);
  if (cell < longest / 600.0) {
    cell = longest / 600.0;
    reason = fmt::format("a 600th of the longest side, {}", length_text(longest));
  }
  const double past = std::min(input.seen_past_m, longest * kDeepest / kDeeperThanSeenPast);
  if (cell < past / kSeenPastPerCell) {
    cell = past / kSeenPastPerCell;
    reason = fmt::format("an {:g}th of the {} that frames see past what others measured",
                         kSeenPastPerCell, length_text(past));
  }
  if (input.grid) {
    cell = longest / *input.grid;
    reason = fmt::format("voxel-grid {} along {}", *input.grid, length_text(longest));
  }
  scale.cell_m = choose("voxel-size", input.cell_m, cell, reason);
  // Many views outvote a misplaced one; few do not.
  const double few = few_views(input) ? 27.0 / double(input.views.size() + 1) : 0.0;
  double truncation = std::max((3.0 + few) * input.noise_m, 2.5 * scale.cell_m);
  reason = fmt::format("the larger of {:.1f} times the noise of {} and 2.5 voxels", 3.0 + few,
                       length_text(input.noise_m));
  if (truncation < kDeeperThanSeenPast * past) {
    truncation = kDeeperThanSeenPast * past;
    reason = fmt::format("{:g} times the {} that frames see past what others measured",
                         kDeeperThanSeenPast, length_text(past));
  }
  scale.truncation_m = choose("truncation", options.truncation_m, truncation, reason);
  scale.full_weight_behind_m = scale.truncation_m * 2.0 / 3.0;
  scale.cylinder = input.cylinder;
  scale.platters = input.platters;
  // Without a visible platter nothing is extended downwards.
  if (input.cylinder && input.cylinder->margin_m > 0.0) scale.floor_m = input.cylinder->margin_m;
  out.fit_reach_m =
      choose("fit-reach", options.fit_reach_m, std::max(0.55 * input.spacing_m, 1.2 * scale.cell_m),
             "0.55 times the spacing of a frame's points");
  return out;
}

}  // namespace turnscan::tsdf
