#include <algorithm>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/length_text.hpp>
#include <turnscan/reconstruction/point_stages.hpp>
#include <turnscan/reconstruction/point_stream.hpp>
#include <turnscan/reconstruction/scan_statistics.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>

namespace turnscan {

namespace {

/// Fewer points than this make no object, and tell no scale.
constexpr std::size_t kLeastPoints = 100;
/// Automatic voxels are no finer than this part of the cloud's longest side.
constexpr double kFinest = 1.0 / 1000.0;

/// The longest side that the cloud shows; of an object of which only one side was seen, also twice
/// the distance from the axis.
double longest_side(const MergedCloud& cloud, bool turns) {
  double longest = bounds(cloud.cloud.points).size().maxCoeff();
  if (!turns) return longest;
  for (const Vec3f& p : cloud.cloud.points)
    longest = std::max(longest, 2.0 * std::hypot(double(p.x()), double(p.z())));
  return longest;
}

/// The frames of a cloud whose points lie in their order.
std::vector<PointsSeen> frames_of(const MergedCloud& merged) {
  const PointCloud& cloud = merged.cloud;
  std::vector<PointsSeen> frames;
  for (std::size_t begin = 0; begin < cloud.size();) {
    std::size_t end = begin;
    while (end < cloud.size() && cloud.frame[end] == cloud.frame[begin]) ++end;
    PointsSeen seen;
    seen.points = std::span(cloud.points).subspan(begin, end - begin);
    if (!cloud.colors.empty()) seen.colors = std::span(cloud.colors).subspan(begin, end - begin);
    seen.viewpoint = merged.viewpoints[cloud.frame[begin]];
    frames.push_back(seen);
    begin = end;
  }
  return frames;
}

}  // namespace

Result<> PointStream::add(const std::vector<FramePart>& parts,
                          const std::vector<Viewpoint>& viewpoints, bool whole,
                          const RunContext& context) {
  const bool known = scale_.has_value();
  std::vector<PointsSeen> frames;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    returns_ += parts[i].returns;
    if (keep_ || !known) append(parts[i], viewpoints[i], cloud_);
    frames.push_back({parts[i].cloud.points, parts[i].cloud.colors, viewpoints[i]});
  }
  if (options_.merge.cloud_outliers) return {};  // all are needed before any can be counted
  if (known) return sums_->add(frames);
  if (cloud_.cloud.size() < kLeastPoints) return {};
  TURNSCAN_TRY(context.check());
  return begin(whole);
}

/// Chooses the scale from the points that are there, and adds them up.
Result<> PointStream::begin(bool whole) {
  scale_ = scale_of(cloud_, whole);
  sums_.emplace(scale_->voxel_m, options_.candidates);
  TURNSCAN_TRY(sums_->add(frames_of(cloud_)));
  if (!keep_) cloud_ = MergedCloud();
  return {};
}

PointStream::Scale PointStream::scale_of(const MergedCloud& cloud, bool whole) const {
  Scale scale;
  // Noise makes neighbouring pixels lie apart; without it they are the spacing of the pixels.
  const double noise = look_.noise_m, step = look_.spacing_m;
  scale.pixels_m = std::sqrt(std::max(0.25 * step * step, step * step - 2 * noise * noise));
  const CloudStatistics statistics = cloud_statistics(cloud, 3.0 * std::max(scale.pixels_m, noise));
  scale.noise_m = std::max(statistics.noise_m, 1e-5);
  scale.spacing_m = statistics.spacing_m > 0.0 ? statistics.spacing_m : step;
  const double longest = longest_side(cloud, !whole && look_.cylinder.has_value());
  if (options_.voxels.size_m) {
    scale.voxel_m = *options_.voxels.size_m;
    scale.reason = "given";
    return scale;
  }
  if (options_.voxels.grid) {
    scale.voxel_m = longest / *options_.voxels.grid;
    scale.reason = fmt::format("voxel-grid {} along {}{}", *options_.voxels.grid, mm(longest),
                               whole ? "" : ", as the first frames show");
    return scale;
  }
  scale.automatic = true;
  scale.least_m = profiles_ ? frames_apart(cloud, scale.pixels_m) : 0.0;
  scale.voxel_m = std::max({2.0 * scale.spacing_m, scale.noise_m, scale.least_m});
  scale.reason =
      scale.voxel_m == scale.least_m
          ? fmt::format("the profiles lie up to {} apart", mm(scale.least_m))
          : fmt::format(
                "the larger of the thickness of the cloud, {}, and twice its "
                "spacing, {}{}",
                mm(scale.noise_m), mm(scale.spacing_m), whole ? "" : ", in the first frames");
  if (scale.voxel_m < kFinest * longest) {
    scale.voxel_m = kFinest * longest;
    scale.reason = fmt::format("a 1000th of the cloud's longest side {}", mm(longest));
  }
  return scale;
}

/// The second statistical filter, on all points.
Result<> PointStream::filter_cloud(const RunContext& context) {
  PointCloud& cloud = cloud_.cloud;
  if (cloud.empty()) return {};
  TURNSCAN_ASSIGN(const auto keep, statistical_outlier_mask(std::span<const Vec3f>(cloud.points),
                                                            options_.outliers, context));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (!keep[i]) continue;
    cloud.points[kept] = cloud.points[i];
    cloud.frame[kept] = cloud.frame[i];
    if (!cloud.colors.empty()) cloud.colors[kept] = cloud.colors[i];
    ++kept;
  }
  cloud.points.resize(kept);
  cloud.frame.resize(kept);
  if (!cloud.colors.empty()) cloud.colors.resize(kept);
  return cloud.size() < kLeastPoints ? Result<>() : begin(true);
}

/// Gives the sums. The scan may have turned out thicker, or sparser, than its first frames: then
/// automatic voxels are joined.
Result<Measurements> PointStream::measure(const RunContext& context, Reconstruction& out) {
  TURNSCAN_ASSIGN(Measurements measured, sums_->collect(1, context));
  const CloudStatistics statistics =
      cloud_statistics(measured, 3.0 * std::max(scale_->pixels_m, scale_->noise_m));
  // Cells of half a voxel hide what is thinner than they are; the first frames have seen that.
  scale_->noise_m = std::max(scale_->noise_m, statistics.noise_m);
  if (statistics.spacing_m > 0.0) scale_->spacing_m = statistics.spacing_m;
  out.merged_noise_m = scale_->noise_m;
  const double wanted = std::max({2.0 * scale_->spacing_m, scale_->noise_m, scale_->least_m});
  const auto joined = int(std::clamp(std::lround(wanted / scale_->voxel_m), 1L, 1000L));
  if (scale_->automatic && joined > 1) {
    scale_->reason = fmt::format(
        "{} of the first frames' {}: the thickness of the cloud is {}, "
        "its spacing {}",
        joined, mm(scale_->voxel_m), mm(scale_->noise_m), mm(scale_->spacing_m));
    TURNSCAN_ASSIGN(measured, sums_->collect(joined, context));
  }
  out.choices.push_back({"voxel-size", mm(measured.grid.size_m()), scale_->reason, -1});
  return measured;
}

Result<> PointStream::finish(const StageSink& sink, const RunContext& context,
                             Reconstruction& out) {
  Measurements measured;
  {
    const StageTimer timer(out, "merge");
    if (options_.merge.cloud_outliers) TURNSCAN_TRY(filter_cloud(context));
    out.points = sums_ ? sums_->points() : cloud_.cloud.size();
    if (!sums_)
      return fail(ErrorCode::kTooFewPoints,
                  "{} of {} returns are left after crop and filter; check the turntable's place, "
                  "--crop-margin and --crop-radius",
                  out.points, returns_);
    if (sink && options_.keep_points) TURNSCAN_TRY(sink("merged", cloud_.cloud));
    cloud_ = MergedCloud();
  }
  {
    const StageTimer timer(out, "voxels");
    TURNSCAN_ASSIGN(measured, measure(context, out));
    sums_.reset();
  }
  return reconstruct_points(measured, scale_->spacing_m, look_.cylinder, options_, sink, context,
                            out);
}

}  // namespace turnscan
