#include <algorithm>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/estimation/scan_statistics.hpp>
#include <turnscan/reconstruction/points/point_method.hpp>
#include <turnscan/reconstruction/points/point_stages.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/voxels/point_sums.hpp>

namespace turnscan::points {

namespace {

/// Fewer points do not form an object, and determine no scale.
constexpr std::size_t kMinPoints = 100;
/// Automatic voxels are not finer than this share of the cloud's longest side.
constexpr double kFinest = 1.0 / 1000.0;

/// The longest side of the cloud; if only one side of the object was seen, also twice the distance
/// from the axis.
double longest_side(const voxels::MergedCloud& cloud, bool turns) {
  double longest = bounds(cloud.cloud.points).size().maxCoeff();
  if (!turns) return longest;
  for (const Vec3f& p : cloud.cloud.points)
    longest = std::max(longest, 2.0 * std::hypot(double(p.x()), double(p.z())));
  return longest;
}

/// The frames of a cloud whose points are in frame order.
std::vector<voxels::PointsSeen> frames_of(const voxels::MergedCloud& merged) {
  const PointCloud& cloud = merged.cloud;
  std::vector<voxels::PointsSeen> frames;
  for (std::size_t begin = 0; begin < cloud.size();) {
    std::size_t end = begin;
    while (end < cloud.size() && cloud.frame[end] == cloud.frame[begin]) ++end;
    voxels::PointsSeen seen;
    seen.points = std::span(cloud.points).subspan(begin, end - begin);
    if (!cloud.colors.empty()) seen.colors = std::span(cloud.colors).subspan(begin, end - begin);
    seen.viewpoint = merged.viewpoints[cloud.frame[begin]];
    frames.push_back(seen);
    begin = end;
  }
  return frames;
}

/// Whether any frame has neighbours along rows and columns, with surface between them; the profiles
/// of a line scanner have none.
bool any_grid(std::span<const Frame> frames) {
  return std::any_of(frames.begin(), frames.end(), [](const Frame& frame) {
    return !frame.depth.pixels.empty() || (frame.grid_width > 1 && frame.grid_height > 1);
  });
}

class PointMethod final : public Method {
 public:
  explicit PointMethod(const MethodInput& input)
      : options_(input.options),
        estimate_(input.estimate),
        recipe_{&input.header,          input.rays,           input.estimate.cylinder,
                input.options.outliers, input.T_object_table, input.share},
        profiles_(!any_grid(input.first_frames)),
        whole_(input.whole) {}

  static Result<std::unique_ptr<Method>> create(const MethodInput& input) {
    return std::make_unique<PointMethod>(input);
  }

  Result<> add(std::span<const PosedFrame> frames, const FrameReader& read,
               const RunContext& context, Reconstruction& out) override;
  Result<> begin_pass(const PassInput& pass, const RunContext& context) override;
  Result<> finish(const StageSink& sink, const RunContext& context, Reconstruction& out) override;

 private:
  /// The voxel size, and the values from which it was chosen.
  struct VoxelScale {
    double voxel_m = 0.0, noise_m = 0.0, spacing_m = 0.0, pixels_m = 0.0;
    double profile_spacing_m = 0.0;  ///< distance between profiles
    bool automatic = false;
    std::string reason;
  };

  Result<> add_parts(const std::vector<voxels::FramePart>& parts,
                     const std::vector<Viewpoint>& viewpoints, const RunContext& context);
  /// Whether nothing can be counted before all points are known.
  bool whole_cloud_first() const {
    return options_.merge.cloud_outliers || options_.voxels.in_bounds;
  }
  Result<> filter_cloud(const RunContext& context);
  Result<> choose_scale(bool whole);
  VoxelScale scale_of(const voxels::MergedCloud& cloud, bool whole) const;
  Result<voxels::MeasuredCells> measure(const RunContext& context, Reconstruction& out);

  const ReconstructOptions& options_;
  estimation::ScanEstimate estimate_;
  voxels::FrameRecipe recipe_;
  bool profiles_;  ///< frames are lines of points without neighbours across
  bool whole_;     ///< the first frames are all frames
  bool keep_ = options_.keep_points || whole_cloud_first();
  std::uint64_t returns_ = 0;
  voxels::MergedCloud cloud_;  ///< until the scale is chosen, or all of it if it is requested
  std::optional<VoxelScale> scale_;
  std::optional<voxels::PointSums> sums_;
};

Result<> PointMethod::add(std::span<const PosedFrame> frames, const FrameReader& read,
                          const RunContext& context, Reconstruction& out) {
  TURNSCAN_ASSIGN(const auto parts,
                  process_frames<voxels::FramePart>(
                      frames, read, context, [&](const Frame& frame, const PosedFrame& posed) {
                        return voxels::process_frame(frame, recipe_, posed.T_table_sensor);
                      }));
  std::vector<Viewpoint> viewpoints;
  for (const PosedFrame& frame : frames) {
    const Viewpoint& own = recipe_.header->sensors[frame.info.sensor].viewpoint;
    viewpoints.push_back(own.transformed(recipe_.T_object_table
                                             ? *recipe_.T_object_table * frame.T_table_sensor
                                             : frame.T_table_sensor));
  }
  TURNSCAN_TRY(add_parts(parts, viewpoints, context));
  for (const voxels::FramePart& part : parts) {
    ++out.frames;
    out.returns += part.returns;
    out.inside_crop += part.inside_crop;
  }
  return {};
}

Result<> PointMethod::begin_pass(const PassInput& pass, const RunContext& /*context*/) {
  recipe_.cylinder = pass.estimate.cylinder;
  recipe_.T_object_table = pass.T_object_table;
  recipe_.share = pass.share;
  return {};
}

/// Adds the parts of frames, in their order. The first ones determine the voxel size.
Result<> PointMethod::add_parts(const std::vector<voxels::FramePart>& parts,
                                const std::vector<Viewpoint>& viewpoints,
                                const RunContext& context) {
  const bool known = scale_.has_value();
  std::vector<voxels::PointsSeen> frames;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    returns_ += parts[i].returns;
    if (keep_ || !known) voxels::append(parts[i], viewpoints[i], cloud_);
    frames.push_back({parts[i].cloud.points, parts[i].cloud.colors, viewpoints[i]});
  }
  if (whole_cloud_first()) return {};
  if (known) return sums_->add(frames);
  if (cloud_.cloud.size() < kMinPoints) return {};
  TURNSCAN_TRY(context.check());
  return choose_scale(whole_);
}

/// Chooses the scale from the points so far, and sums them.
Result<> PointMethod::choose_scale(bool whole) {
  scale_ = scale_of(cloud_, whole);
  const Vec3d origin = options_.voxels.in_bounds ? bounds(cloud_.cloud.points).min : Vec3d::Zero();
  sums_.emplace(scale_->voxel_m, options_.candidates, origin);
  TURNSCAN_TRY(sums_->add(frames_of(cloud_)));
  if (!keep_) cloud_ = voxels::MergedCloud();
  return {};
}

PointMethod::VoxelScale PointMethod::scale_of(const voxels::MergedCloud& cloud, bool whole) const {
  VoxelScale scale;
  // Noise moves neighbouring pixels apart; without it their distance is the pixel spacing.
  const double noise = estimate_.noise_m, step = estimate_.spacing_m;
  scale.pixels_m = std::sqrt(std::max(0.25 * step * step, step * step - 2 * noise * noise));
  const estimation::CloudStatistics statistics =
      estimation::cloud_statistics(cloud, 3.0 * std::max(scale.pixels_m, noise));
  scale.noise_m = std::max(statistics.noise_m, 1e-5);
  scale.spacing_m = statistics.spacing_m > 0.0 ? statistics.spacing_m : step;
  const double longest = longest_side(cloud, !whole && estimate_.cylinder.has_value());
  if (options_.voxels.size_m) {
    scale.voxel_m = *options_.voxels.size_m;
    scale.reason = "given";
    return scale;
  }
  if (options_.voxels.grid) {
    scale.voxel_m = longest / *options_.voxels.grid;
    scale.reason = fmt::format("voxel-grid {} along {}{}", *options_.voxels.grid,
                               length_text(longest), whole ? "" : ", as the first frames show");
    return scale;
  }
  scale.automatic = true;
  scale.profile_spacing_m = profiles_ ? estimation::frames_apart(cloud, scale.pixels_m) : 0.0;
  scale.voxel_m = std::max({2.0 * scale.spacing_m, scale.noise_m, scale.profile_spacing_m});
  scale.reason =
      scale.voxel_m == scale.profile_spacing_m
          ? fmt::format("the profiles lie up to {} apart", length_text(scale.profile_spacing_m))
          : fmt::format(
                "the larger of the thickness of the cloud, {}, and twice its "
                "spacing, {}{}",
                length_text(scale.noise_m), length_text(scale.spacing_m),
                whole ? "" : ", in the first frames");
  if (scale.voxel_m < kFinest * longest) {
    scale.voxel_m = kFinest * longest;
    scale.reason = fmt::format("a 1000th of the cloud's longest side {}", length_text(longest));
  }
  return scale;
}

/// The second statistical filter, on all points.
Result<> PointMethod::filter_cloud(const RunContext& context) {
  PointCloud& cloud = cloud_.cloud;
  if (cloud.empty()) return {};
  TURNSCAN_ASSIGN(const auto keep,
                  outliers::statistical_outlier_mask(cloud.points, options_.outliers, context));
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
  return {};
}

/// Returns the sums. If the scan turned out thicker, or sparser, than its first frames, automatic
/// voxels are joined.
Result<voxels::MeasuredCells> PointMethod::measure(const RunContext& context, Reconstruction& out) {
  TURNSCAN_ASSIGN(voxels::MeasuredCells measured, sums_->collect(1, context));
  const estimation::CloudStatistics statistics =
      estimation::cloud_statistics(measured, 3.0 * std::max(scale_->pixels_m, scale_->noise_m));
  // Cells of half a voxel hide thinner clouds, whose thickness is known from the first frames.
  scale_->noise_m = std::max(scale_->noise_m, statistics.noise_m);
  if (statistics.spacing_m > 0.0) scale_->spacing_m = statistics.spacing_m;
  out.merged_noise_m = scale_->noise_m;
  const double wanted =
      std::max({2.0 * scale_->spacing_m, scale_->noise_m, scale_->profile_spacing_m});
  const auto joined = int(std::clamp(std::lround(wanted / scale_->voxel_m), 1L, 1000L));
  if (scale_->automatic && joined > 1) {
    scale_->reason = fmt::format(
        "{} of the first frames' {}: the thickness of the cloud is {}, "
        "its spacing {}",
        joined, length_text(scale_->voxel_m), length_text(scale_->noise_m),
        length_text(scale_->spacing_m));
    TURNSCAN_ASSIGN(measured, sums_->collect(joined, context));
  }
  out.choices.push_back({"voxel-size", length_text(measured.grid.size_m()), scale_->reason, -1});
  return measured;
}

Result<> PointMethod::finish(const StageSink& sink, const RunContext& context,
                             Reconstruction& out) {
  voxels::MeasuredCells measured;
  {
    const StageTimer timer(out.stages, "merge");
    if (options_.merge.cloud_outliers) TURNSCAN_TRY(filter_cloud(context));
    if (whole_cloud_first() && cloud_.cloud.size() >= kMinPoints) TURNSCAN_TRY(choose_scale(true));
    out.points = sums_ ? sums_->points() : cloud_.cloud.size();
    if (!sums_)
      return fail(ErrorCode::kTooFewPoints,
                  "{} of {} returns are left after crop and filter; check the turntable's pose, "
                  "--crop-margin and --crop-radius",
                  out.points, returns_);
    if (sink && options_.keep_points) TURNSCAN_TRY(sink("merged", cloud_.cloud));
    cloud_ = voxels::MergedCloud();
  }
  {
    const StageTimer timer(out.stages, "voxels");
    TURNSCAN_ASSIGN(measured, measure(context, out));
    if (sink && options_.candidates.method == CandidateMethod::kSubVoxel)
      TURNSCAN_TRY(sink("sub-voxels", sums_->sub_voxels()));
    sums_.reset();
  }
  // The platter of a pass is no floor for the surface seen in other passes.
  const auto cylinder = recipe_.T_object_table ? std::nullopt : estimate_.cylinder;
  return reconstruct_points(measured, scale_->spacing_m, cylinder, options_, sink, context, out);
}

/// Common to both methods, which differ only in the surface.
MethodEntry entry_of(SurfaceMethod method) {
  MethodEntry entry;
  entry.method = method;
  entry.option_stages = {"crop",    "outliers", "merge", "voxels", "candidates", "components",
                         "normals", "refine",   "base",  "finish", "texture"};
  entry.options = {"method", "repair"};
  entry.saveable_stages = {"merged", "sub-voxels", "voxels", "candidates", "refined", "oriented"};
  entry.create = &PointMethod::create;
  return entry;
}

}  // namespace

MethodEntry poisson_method() {
  MethodEntry entry = entry_of(SurfaceMethod::kPoisson);
  for (const char* option :
       {"poisson-depth", "poisson-samples", "poisson-scale", "poisson-point-weight"})
    entry.options.emplace_back(option);
  return entry;
}

MethodEntry concave_hull_method() {
  MethodEntry entry = entry_of(SurfaceMethod::kConcaveHull);
  entry.options.emplace_back("alpha");
  return entry;
}

}  // namespace turnscan::points
