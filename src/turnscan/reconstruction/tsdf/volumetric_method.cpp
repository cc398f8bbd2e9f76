#include <algorithm>
#include <map>
#include <mutex>
#include <turnscan/core/figure_text.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/grid/isosurface.hpp>
#include <turnscan/reconstruction/estimation/free_space_violation.hpp>
#include <turnscan/reconstruction/estimation/scan_statistics.hpp>
#include <turnscan/reconstruction/estimation/sensor_filter.hpp>
#include <turnscan/reconstruction/seen_space.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/tsdf/piece_measures.hpp>
#include <turnscan/reconstruction/tsdf/platter_columns.hpp>
#include <turnscan/reconstruction/tsdf/volumetric.hpp>
#include <turnscan/reconstruction/tsdf/volumetric_method.hpp>
#include <turnscan/reconstruction/views/profiles.hpp>
#include <turnscan/reconstruction/views/view_store.hpp>

namespace turnscan::tsdf {

namespace {

/// Number of views that are summed together, brick by brick; independent of how they arrive.
constexpr std::size_t kViewsAtOnce = 16;
/// Maximum ratio of the final noise to the initial estimate.
constexpr double kNoiseSlack = 1.3;
constexpr std::size_t kPreviewBricks = 1500;

/// Platters that differ by less are the same: cosine of 1.8 degrees, and metres.
constexpr double kSamePlane = 0.9995, kSameHeight_m = 0.002;

/// Fewer points do not form an object.
constexpr std::uint64_t kMinPoints = 100;

/// Disagreement of the views. thickness_m: if the frames' poses disagree, the cloud is thicker than
/// one frame's noise; 0 if there are too few points. seen_past_m: see
/// estimation/free_space_violation.hpp.
struct Disagreement {
  double thickness_m = 0.0, seen_past_m = 0.0;
};
Disagreement disagreement(const VolumetricInput& input, double noise_m, bool images) {
  const voxels::MergedCloud sample = sample_points(input);
  Disagreement out;
  if (sample.cloud.size() < 100) return out;
  const double start_m = 3.0 * std::max(input.spacing_m, noise_m);
  out.thickness_m = estimation::one_sided_statistics(sample, start_m, input.profiles).noise_m;
  if (images)
    out.seen_past_m = estimation::free_space_violation(input.views, sample.cloud.points, noise_m,
                                                       input.spacing_m);
  return out;
}

/// The pass whose frames are being added.
struct CurrentPass {
  std::optional<Pose> T_object_table;  ///< nullopt: there is only one pass
  std::optional<Cylinder> cylinder;    ///< above its table
  std::vector<std::optional<views::LightSheet>> sheets;
  const ObjectPartition* share;  ///< nullptr: all of the table
};

/// A recorder may have cropped so high, whatever margin is found now.
constexpr double kRecordedMargin_m = 0.006;

/// The height above the margin in the frame of a sensor.
Eigen::Vector4f above_crop(const Cylinder& cylinder, const Pose& T_table_sensor) {
  const double margin_m = std::max(cylinder.margin_m, kRecordedMargin_m);
  const Eigen::Vector4d row = T_table_sensor.matrix().row(1);
  return (row - Eigen::Vector4d(0.0, 0.0, 0.0, margin_m)).cast<float>();
}

/// Result of a frame: a view, or a profile of a line scanner, which waits for the following ones.
struct FrameView {
  views::DepthView view;
  std::optional<views::Profile> profile;
  std::uint64_t returns = 0, inside_crop = 0;
};

class VolumetricMethod final : public Method {
 public:
  static Result<std::unique_ptr<Method>> create(const MethodInput& input);

  explicit VolumetricMethod(const MethodInput& input)
      : header_(input.header),
        options_(input.options),
        rays_(input.rays),
        noise_m_(input.estimate.noise_m),
        pass_{input.T_object_table, input.estimate.cylinder, input.estimate.sheets, input.share} {}

  Result<> add(std::span<const PosedFrame> frames, const FrameReader& read,
               const RunContext& context, Reconstruction& out) override;
  Result<> begin_pass(const PassInput& pass, const RunContext& context) override;
  /// Chooses the scale from the views so far.
  Result<> begin(const RunContext& context) override;
  Result<TriangleMesh> preview(const RunContext& context) const override;
  Result<> finish(const StageSink& sink, const RunContext& context, Reconstruction& out) override;

 private:
  Result<FrameView> view_of(const Frame& frame, const Pose& T_table_sensor) const;
  void add_platter(const Pose& T_object_table);
  void stand_on_common_platter();
  Result<> flush_profiles(const RunContext& context);
  Result<> add_profiles(const std::vector<views::Profile>& group, std::uint32_t sensor,
                        const RunContext& context);
  Result<> add_view(views::DepthView view, std::uint32_t sensor, const RunContext& context);
  Result<> integrate_pending(bool all, const RunContext& context);
  Result<> correct_noise(Reconstruction& out, const RunContext& context);
  std::shared_ptr<const SeenSpace> seen_space(bool filtered) const;

  const SequenceHeader& header_;
  const ReconstructOptions& options_;
  const std::vector<RayTable>& rays_;
  double noise_m_;  ///< of a depth value along its ray, from the first frames
  CurrentPass pass_;
  views::ViewScale view_scale_;
  VolumetricInput input_;    ///< its views are set only at the end
  bool are_images_ = false;  ///< all are depth images
  bool begun_ = false;
  std::map<std::uint32_t, views::ProfileGroups> profiles_;  ///< per sensor, for line scanners
  std::vector<views::DepthView> pending_;
  std::vector<std::uint32_t> pending_sensor_;
  views::ViewStore kept_;
  VolumetricScale scale_;
  mutable std::mutex mutex_;  ///< guards the members below
  Integrator integrator_;
  std::vector<Platter> platters_;  ///< of several passes
  double crop_margin_m_ = 0.0;     ///< largest of theirs
};

Result<std::unique_ptr<Method>> VolumetricMethod::create(const MethodInput& in) {
  auto method = std::make_unique<VolumetricMethod>(in);
  const double noise = in.estimate.noise_m, apart = in.estimate.even_spacing_m;
  VolumetricInput& input = method->input_;
  input.noise_m = noise;
  // Noise moves neighbouring pixels apart; without it their distance is the pixel spacing.
  input.spacing_m = std::sqrt(std::max(0.25 * apart * apart, apart * apart - 2 * noise * noise));
  const auto& sensors = in.header.sensors;
  if (std::all_of(sensors.begin(), sensors.end(),
                  [](const SensorInfo& s) { return s.kind == SensorKind::kPointScanner; }))
    input.cells_of_spacing = 0.9;
  method->are_images_ = std::all_of(sensors.begin(), sensors.end(), [](const SensorInfo& s) {
    return s.kind == SensorKind::kDepthCamera;
  });
  input.profiles = in.estimate.profiles;
  if (in.T_object_table)
    method->add_platter(*in.T_object_table);
  else
    input.cylinder = in.estimate.cylinder;
  input.cell_m = in.options.voxels.size_m;
  input.grid = in.options.voxels.grid;
  TURNSCAN_ASSIGN(input.keep, objects_to_keep(in.options.components));
  input.gap_m = in.options.components.gap_m.value_or(0.0);
  method->view_scale_ = {std::max(8.0 * noise, 4.0 * input.spacing_m), input.spacing_m,
                         in.options.color, in.T_object_table.has_value()};
  input.colored = in.options.color;
  input.measured_only = in.options.for_placing;
  return method;
}

Result<> VolumetricMethod::add(std::span<const PosedFrame> frames, const FrameReader& read,
                               const RunContext& context, Reconstruction& out) {
  TURNSCAN_ASSIGN(auto views,
                  process_frames<FrameView>(frames, read, context,
                                            [&](const Frame& frame, const PosedFrame& posed) {
                                              return view_of(frame, posed.T_table_sensor);
                                            }));
  for (std::size_t i = 0; i < views.size(); ++i) {
    ++out.frames;
    out.returns += views[i].returns;
    out.inside_crop += views[i].inside_crop;
    const std::uint32_t sensor = frames[i].info.sensor;
    if (views[i].profile) {
      TURNSCAN_TRY(
          add_profiles(profiles_[sensor].add(std::move(*views[i].profile)), sensor, context));
    } else {
      TURNSCAN_TRY(add_view(std::move(views[i].view), sensor, context));
    }
  }
  return {};
}

/// May be called from several threads at once.
Result<FrameView> VolumetricMethod::view_of(const Frame& frame, const Pose& T_table_sensor) const {
  FrameView out;
  std::optional<SensorCrop> table_crop;
  if (pass_.cylinder) table_crop.emplace(*pass_.cylinder, T_table_sensor);
  const Pose T = pass_.T_object_table ? *pass_.T_object_table * T_table_sensor : T_table_sensor;
  const auto keeps = [&](const Vec3f& p) {
    return (!table_crop || table_crop->keeps(p)) &&
           (!pass_.share ||
            pass_.share->contains((T_table_sensor * p.cast<double>()).cast<float>()));
  };
  views::ViewScale scale = view_scale_;
  if (pass_.T_object_table && pass_.cylinder)
    scale.seen_above = above_crop(*pass_.cylinder, T_table_sensor);
  const std::size_t s = frame.info.sensor;
  if (!pass_.sheets.at(s)) {
    TURNSCAN_ASSIGN(out.view,
                    views::make_view(frame, header_.sensors.at(s), rays_.at(s), T, scale, keeps));
    out.returns = out.view.returns;
    out.inside_crop = out.view.kept;
    return out;
  }
  TURNSCAN_ASSIGN(FramePoints points, points_of(frame, header_.sensors[s], rays_[s]));
  out.returns = points.cloud.size();
  points = views::in_sheet_order(points, *pass_.sheets[s]);
  if (table_crop || pass_.share) points = kept_points(points, keeps);
  out.inside_crop = points.cloud.size();
  out.profile = views::Profile{std::move(points), T};
  return out;
}

Result<> VolumetricMethod::flush_profiles(const RunContext& context) {
  for (auto& [sensor, group] : profiles_)
    TURNSCAN_TRY(add_profiles(group.flush(), sensor, context));
  return {};
}

Result<> VolumetricMethod::begin_pass(const PassInput& pass, const RunContext& context) {
  TURNSCAN_TRY(flush_profiles(context));
  pass_ = {pass.T_object_table, pass.estimate.cylinder, pass.estimate.sheets, pass.share};
  input_.profiles &= pass.estimate.profiles;
  add_platter(pass.T_object_table);
  return {};
}

/// Adds that of the current pass.
void VolumetricMethod::add_platter(const Pose& T_object_table) {
  const std::lock_guard lock(mutex_);
  platters_.push_back(platter_of(T_object_table));
  if (pass_.cylinder) crop_margin_m_ = std::max(crop_margin_m_, pass_.cylinder->margin_m);
}

/// If the object has the same pose in all passes none saw its base, which ends as that of one pass.
void VolumetricMethod::stand_on_common_platter() {
  const auto at_zero = [](const Platter& platter) {
    return platter.up.y() > kSamePlane && std::abs(platter.offset_m) < kSameHeight_m;
  };
  if (platters_.empty() || !std::all_of(platters_.begin(), platters_.end(), at_zero)) return;
  scale_.volume.platters.clear();
  scale_.volume.floor_m = crop_margin_m_;
}

Result<> VolumetricMethod::add_profiles(const std::vector<views::Profile>& group,
                                        std::uint32_t sensor, const RunContext& context) {
  if (group.empty()) return {};
  return add_view(views::view_of_profiles(group, *pass_.sheets[sensor], view_scale_), sensor,
                  context);
}

Result<> VolumetricMethod::add_view(views::DepthView view, std::uint32_t sensor,
                                    const RunContext& context) {
  if (view.empty()) return {};
  pending_.push_back(std::move(view));
  pending_sensor_.push_back(sensor);
  return begun_ ? integrate_pending(false, context) : Result<>();
}

Result<> VolumetricMethod::begin(const RunContext& context) {
  input_.views = std::move(pending_);
  if (are_images_) input_.filter_share = estimation::share_of_neighbours(input_.views, noise_m_);
  const Disagreement found = disagreement(input_, noise_m_, are_images_);
  input_.noise_m = std::max(noise_m_, found.thickness_m);
  input_.seen_past_m = found.seen_past_m;
  scale_ = choose_scale(input_, options_.volumetric, measured_box(input_));
  pending_ = std::move(input_.views);
  {
    const std::lock_guard lock(mutex_);
    integrator_ = Integrator(scale_.volume);
  }
  begun_ = true;
  return integrate_pending(false, context);
}

/// Integrates the complete batches of the pending views, or all of them.
Result<> VolumetricMethod::integrate_pending(bool all, const RunContext& context) {
  std::size_t done = 0;
  while (done + (all ? 1 : kViewsAtOnce) <= pending_.size()) {
    const std::size_t count = std::min(kViewsAtOnce, pending_.size() - done);
    {
      const std::lock_guard lock(mutex_);
      TURNSCAN_TRY(integrator_.integrate(std::span(pending_).subspan(done, count),
                                         {kept_.views(), float(kept_.stride())}, context));
    }
    for (std::size_t v = done; v < done + count; ++v)
      kept_.add(std::move(pending_[v]), pending_sensor_[v]);
    done += count;
  }
  pending_.erase(pending_.begin(), pending_.begin() + std::ptrdiff_t(done));
  pending_sensor_.erase(pending_sensor_.begin(), pending_sensor_.begin() + std::ptrdiff_t(done));
  return {};
}

/// If the frames' poses disagree more than the first ones suggested, the volume is built again from
/// the views that were kept.
Result<> VolumetricMethod::correct_noise(Reconstruction& out, const RunContext& context) {
  const Disagreement found = disagreement(input_, noise_m_, are_images_);
  out.merged_noise_m = found.thickness_m;
  const double noise = std::max(noise_m_, out.merged_noise_m);
  const bool noisier = noise > kNoiseSlack * input_.noise_m;
  input_.noise_m = noise, input_.seen_past_m = found.seen_past_m;
  const VolumetricScale scale = choose_scale(input_, options_.volumetric, measured_box(input_));
  const bool wider = scale.volume.truncation_m > kNoiseSlack * scale_.volume.truncation_m;
  if (options_.volumetric.truncation_m || !(noisier || wider)) return {};
  out.notes.push_back(
      noisier ? fmt::format("the frames' poses disagree by {}, which the first frames did not "
                            "show: the volume was integrated again",
                            length_text(noise))
              : fmt::format("frames see {} deep past what others measured, which the first frames "
                            "did not show: the volume was integrated again",
                            length_text(found.seen_past_m)));
  scale_ = scale;
  Integrator integrator(scale_.volume);
  const std::span<const views::DepthView> all(input_.views);
  for (std::size_t v = 0; v < all.size(); v += kViewsAtOnce)
    TURNSCAN_TRY(integrator.integrate(all.subspan(v, std::min(kViewsAtOnce, all.size() - v)),
                                      {all.first(v), 1.0f}, context));
  const std::lock_guard lock(mutex_);
  integrator_ = std::move(integrator);
  return {};
}

Result<TriangleMesh> VolumetricMethod::preview(const RunContext& context) const {
  Volume volume;
  VolumeScale scale;
  {
    const std::lock_guard lock(mutex_);
    volume = integrator_.extract_coarse_volume(kPreviewBricks);
    scale = integrator_.scale();
    scale.platters = platters_;
  }
  if (volume.brick_count() == 0) return TriangleMesh();
  scale.cell_m = volume.cell_m;
  scale.truncation_m = volume.truncation_m;
  TURNSCAN_TRY(close_holes(volume, scale, Foot(), context));
  TURNSCAN_ASSIGN(const BrickGrid grid, to_grid(volume, std::size_t(1) << 30));
  return isosurface(grid, MarchingCells::kTetrahedra, context);
}

std::shared_ptr<const SeenSpace> VolumetricMethod::seen_space(bool filtered) const {
  auto seen = std::make_shared<SeenSpace>();
  seen->views = evenly_spread(input_.views, SeenSpace::kMaxViews);
  if (pass_.cylinder && pass_.cylinder->margin_m > 0.0) seen->floor_m = 0.0;
  seen->noise_m = noise_m_;
  seen->spacing_m = input_.spacing_m;
  seen->filtered = filtered;
  return seen;
}

Result<> VolumetricMethod::finish(const StageSink& sink, const RunContext& context,
                                  Reconstruction& out) {
  TURNSCAN_TRY(flush_profiles(context));
  out.points = out.inside_crop;
  if (out.inside_crop < kMinPoints)
    return fail(ErrorCode::kTooFewPoints,
                "{} of {} returns are left after the crop; check the turntable's pose, "
                "--crop-margin and --crop-radius",
                out.inside_crop, out.returns);
  {
    const StageTimer timer(out.stages, "frames");
    TURNSCAN_TRY(integrate_pending(true, context));
  }
  TURNSCAN_TRY(context.check());
  input_.views = kept_.take();
  input_.platters = scale_.volume.platters = platters_;
  {
    const StageTimer timer(out.stages, "noise");
    TURNSCAN_TRY(correct_noise(out, context));
  }
  stand_on_common_platter();
  TURNSCAN_ASSIGN(VolumetricResult result,
                  reconstruct_volume(input_, scale_, integrator_, options_.volumetric,
                                     options_.components.min_share, context));
  if (options_.volumetric.sharpen && result.filter_share > 0.0)
    out.notes.push_back(
        fmt::format("the sensor averages over neighbouring pixels ({:.0f} % of a depth comes from "
                    "its neighbours in the row): edges are sharpened",
                    200.0 * result.filter_share));
  if (result.left_out > 0)
    out.notes.push_back(fmt::format(
        "{} left out: hardly a frame measured {}, which is typical of things that do not turn with "
        "the table",
        result.left_out == 1 ? "one thing was" : fmt::format("{} things were", result.left_out),
        result.left_out == 1 ? "it" : "them"));
  out.voxel_size_m = scale_.volume.cell_m;
  out.choices.insert(out.choices.end(), scale_.choices.begin(), scale_.choices.end());
  out.stages.insert(out.stages.end(), result.stages.begin(), result.stages.end());
  const StageTimer timer(out.stages, "check");
  PointCloud fitted;
  for (VolumetricPiece& piece : result.pieces) {
    ObjectResult& object = out.objects.emplace_back(object_of(piece, options_.color));
    object.mesh.name = fmt::format("object {}", out.objects.size());
    fitted.points.insert(fitted.points.end(), object.mesh.vertices.begin(),
                         object.mesh.vertices.end());
    fitted.weights.insert(fitted.weights.end(), piece.support.begin(), piece.support.end());
  }
  if (options_.for_placing) out.seen = seen_space(result.filter_share > 0.0);
  return sink ? sink("fitted", fitted) : Result<>();
}

}  // namespace

MethodEntry volumetric_method() {
  MethodEntry entry;
  entry.method = SurfaceMethod::kVolumetric;
  entry.option_stages = {"crop", "volumetric", "finish", "texture"};
  entry.options = {"speed",      "pass", "colour",           "voxel-size",
                   "voxel-grid", "keep", "min-object-share", "object-gap",
                   "method"};
  entry.saveable_stages = {"fitted"};
  entry.previews = true;
  entry.create = &VolumetricMethod::create;
  return entry;
}

}  // namespace turnscan::tsdf
