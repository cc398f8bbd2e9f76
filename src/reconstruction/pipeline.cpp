#include <algorithm>
#include <chrono>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/finish.hpp>
#include <turnscan/reconstruction/pipeline.hpp>
#include <turnscan/reconstruction/scan_statistics.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan {

namespace {

using Clock = std::chrono::steady_clock;

std::string mm(double metres) { return format_quantity(metres, Quantity::kLength); }

/// One run: the stages in their order share its members.
class Run {
 public:
  Run(const FrameSequence& sequence, const ReconstructOptions& options, const StageSink& sink,
      const RunContext& context)
      : sequence_(sequence), options_(options), sink_(sink), context_(context) {}

  Result<Reconstruction> operator()() {
    TURNSCAN_TRY(timed("look at the data", [&] { return survey(); }));
    if (options_.surface.method == SurfaceMethod::kVolumetric) {
      TURNSCAN_TRY(timed("read", [&] { return read_views(); }));
      TURNSCAN_TRY(timed("volume", [&] { return build_volume(); }));
      return std::move(out_);
    }
    TURNSCAN_TRY(timed("merge", [&] { return merge(); }));
    TURNSCAN_TRY(timed("voxels", [&] { return count_voxels(); }));
    TURNSCAN_TRY(timed("candidates", [&] { return choose_candidates(); }));
    TURNSCAN_TRY(timed("normals", [&] { return orient(); }));
    TURNSCAN_TRY(timed("refine", [&] { return refine(); }));
    TURNSCAN_TRY(timed("base", [&] { return split_objects(); }));
    TURNSCAN_TRY(timed("surface", [&] { return build_surfaces(); }));
    return std::move(out_);
  }

 private:
  template <class Stage>
  Result<> timed(const char* name, const Stage& stage) {
    const auto start = Clock::now();
    auto result = stage();
    out_.stages.push_back({name, std::chrono::duration<double>(Clock::now() - start).count()});
    if (result) return context_.check();
    return result;
  }

  void choose(const std::string& option, const std::string& value, const std::string& reason) {
    out_.choices.push_back({option, value, reason, -1});
  }
  template <class T>
  double length_or(const std::optional<T>& given, const char* option, double automatic,
                   const std::string& reason) {
    const double value = given.value_or(automatic);
    choose(option, mm(value), given ? "given" : reason);
    return value;
  }
  Result<> save(const std::string& stage, const PointCloud& cloud) {
    return sink_ ? sink_(stage, cloud) : Result<>();
  }

  Result<> survey();
  Result<> choose_crop(const std::vector<Vec3f>& sample);
  Result<> read_views();
  Result<> build_volume();
  Result<> merge();
  Result<> count_voxels();
  Result<> choose_candidates();
  Result<> orient();
  Result<> refine();
  Result<> split_objects();
  Result<> build_surfaces();
  Result<ObjectResult> build_surface(const PointCloud& object);

  const FrameSequence& sequence_;
  const ReconstructOptions& options_;
  const StageSink& sink_;
  const RunContext& context_;
  Reconstruction out_;
  FrameRecipe recipe_;
  std::vector<Pose> poses_;
  MergedCloud merged_;
  double cloud_spacing_m_ = 0.0;
  std::optional<VoxelGrid> grid_;
  Components components_;
  Candidates candidates_;
  std::vector<PointCloud> objects_;  ///< oriented points, with base
  VolumetricInput volume_;
};

/// Poses, spacing, noise and crop, from a few frames spread over the scan.
Result<> Run::survey() {
  TURNSCAN_ASSIGN(const FramePoses poses,
                  frame_poses(sequence_.header(), sequence_.frames(), options_.merge.speed_rad_s));
  poses_ = poses.T_table_sensor;
  recipe_ = FrameRecipe::make(sequence_.header());
  recipe_.outliers = options_.outliers;
  const auto& frames = sequence_.frames();
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (frames[i].status == FrameStatus::kOk) usable.push_back(i);
  }
  if (usable.empty())
    return fail(ErrorCode::kTooFewPoints, "the recording has no frame that can be used");
  constexpr std::size_t kLooks = 12;
  std::vector<double> spacing, noise;
  std::vector<Vec3f> sample;
  context_.begin_phase("look at the data", std::min(kLooks, usable.size()));
  for (std::size_t k = 0; k < std::min(kLooks, usable.size()); ++k) {
    const std::size_t i = usable[k * usable.size() / std::min(kLooks, usable.size())];
    TURNSCAN_ASSIGN(const Frame frame, sequence_.read(i));
    const std::size_t s = frame.info.sensor;
    TURNSCAN_ASSIGN(FramePoints points,
                    points_of(frame, sequence_.header().sensors.at(s), recipe_.rays.at(s)));
    for (const Vec3f& p : points.cloud.points) sample.push_back(poses_[i].cast<float>() * p);
    const auto& table = sequence_.header().turntable;
    if (options_.crop.enabled && (table || options_.crop.radius_m)) {
      Cylinder rough;  // the object and its noise, not the platter
      rough.margin_m = options_.crop.margin_m.value_or(0.003);
      rough.radius_m = options_.crop.radius_m.value_or(table->radius_m.value_or(1e3));
      rough.height_m = options_.crop.height_m;
      points = crop(points, SensorCrop(rough, poses_[i]));
    }
    if (points.cloud.size() < 10) continue;
    const FrameStatistics statistics = frame_statistics(points);
    spacing.push_back(statistics.spacing_m);
    noise.push_back(statistics.noise_m);
    context_.advance();
  }
  if (spacing.empty())
    return fail(ErrorCode::kTooFewPoints,
                "none of the frames looked at has 10 points on the object; check the turntable's "
                "place and --crop-margin, --crop-radius");
  std::sort(spacing.begin(), spacing.end());
  std::sort(noise.begin(), noise.end());
  out_.frame_spacing_m = spacing[spacing.size() / 2];
  out_.sensor_noise_m = noise[noise.size() / 2];
  // Rounding to the sensor's unit spreads depth by unit / sqrt(12) at least.
  for (const SensorInfo& sensor : sequence_.header().sensors) {
    if (sensor.kind == SensorKind::kDepthCamera)
      out_.sensor_noise_m = std::max(out_.sensor_noise_m, sensor.depth_unit_m / std::sqrt(12.0));
  }
  return choose_crop(sample);
}

Result<> Run::choose_crop(const std::vector<Vec3f>& sample) {
  const auto& table = sequence_.header().turntable;
  if (!options_.crop.enabled || (!table && !options_.crop.radius_m)) return {};
  Cylinder cylinder;
  cylinder.height_m = options_.crop.height_m;
  std::optional<double> known = options_.crop.radius_m;
  if (!known && table) known = table->radius_m;
  const PlatterReturns platter = measure_platter(sample, std::min(known.value_or(0.5), 0.5));
  const auto found = known ? known : find_platter_radius(sample, platter);
  if (found) {
    choose("crop-radius", mm(*found),
           options_.crop.radius_m ? "given"
           : known                ? "the platter's radius"
                                  : "where the returns of the platter end");
  } else {
    out_.notes.push_back(
        "the platter's radius is not known and its edge was not found: nothing is "
        "cropped sideways; give --crop-radius");
  }
  cylinder.radius_m = found.value_or(1e3);
  double margin = std::max(0.002, 4.0 * out_.sensor_noise_m);
  std::string reason = fmt::format("4 times the sensor's noise of {}", mm(out_.sensor_noise_m));
  if (platter.count > 0) {
    margin = std::max(0.001, platter.height_m + 4.0 * platter.sigma_m);
    reason = fmt::format("the platter's returns lie at {} with a spread of {}; 4 spreads above",
                         mm(platter.height_m), mm(platter.sigma_m));
  }
  cylinder.margin_m = length_or(options_.crop.margin_m, "crop-margin", margin, reason);
  recipe_.cylinder = cylinder;
  return {};
}

/// Windows of all frames for the volumetric method.
Result<> Run::read_views() {
  const double noise = out_.sensor_noise_m, apart = out_.frame_spacing_m;
  volume_.noise_m = noise;
  volume_.spacing_m = std::sqrt(std::max(0.25 * apart * apart, apart * apart - 2 * noise * noise));
  volume_.cylinder = recipe_.cylinder;
  volume_.cell_m = options_.voxels.size_m;
  volume_.grid = options_.voxels.grid;
  TURNSCAN_ASSIGN(volume_.keep, objects_to_keep(options_.components));
  const ViewScale scale{std::max(8.0 * noise, 4.0 * volume_.spacing_m), volume_.spacing_m};
  const auto& frames = sequence_.frames();
  context_.begin_phase("read frames", frames.size());
  std::vector<Result<DepthView>> views(frames.size());
  parallel_for(frames.size(), 1, [&](std::size_t i) {
    if (frames[i].status == FrameStatus::kDropped || context_.cancelled()) return;
    std::optional<SensorCrop> crop;
    if (recipe_.cylinder) crop.emplace(*recipe_.cylinder, poses_[i]);
    const std::size_t s = frames[i].sensor;
    views[i] = sequence_.read(i).and_then([&](const Frame& frame) {
      return make_view(frame, sequence_.header().sensors.at(s), recipe_.rays.at(s), poses_[i],
                       scale, [&](const Vec3f& p) { return !crop || crop->keeps(p); });
    });
    context_.advance();
  });
  TURNSCAN_TRY(context_.check());
  for (std::size_t i = 0; i < views.size(); ++i) {
    TURNSCAN_TRY(views[i]);
    if (frames[i].status == FrameStatus::kDropped) {
      ++out_.dropped_frames;
      continue;
    }
    ++out_.frames;
    out_.returns += views[i]->returns;
    out_.cropped += views[i]->kept;
    if (!views[i]->empty()) volume_.views.push_back(std::move(*views[i]));
  }
  // Where the frames' places disagree, the cloud is thicker than one frame's noise.
  MergedCloud sample;
  sample.cloud.points = sample_points(volume_);
  if (sample.cloud.size() >= 100) {
    const auto start = 3.0 * std::max(volume_.spacing_m, noise);
    out_.merged_noise_m = cloud_statistics(sample, start).noise_m;
    volume_.noise_m = std::max(noise, out_.merged_noise_m);
  }
  return {};
}

Result<> Run::build_volume() {
  out_.points = out_.cropped;
  if (out_.cropped < 100)
    return fail(ErrorCode::kTooFewPoints,
                "{} of {} returns are left after the crop; check the turntable's place, "
                "--crop-margin and --crop-radius",
                out_.cropped, out_.returns);
  TURNSCAN_ASSIGN(
      VolumetricResult result,
      reconstruct_volume(volume_, options_.volumetric, options_.components.min_share, context_));
  for (const VolumetricChoice& c : result.choices) choose(c.option, c.value, c.reason);
  for (const auto& [name, seconds] : result.seconds) out_.stages.push_back({name, seconds});
  PointCloud fitted;
  for (VolumetricPiece& piece : result.pieces) {
    ObjectResult object;
    object.mesh = std::move(piece.mesh);
    object.mesh.name = fmt::format("object {}", out_.objects.size() + 1);
    object.check = check_mesh(object.mesh);
    object.points = piece.points;
    object.invented_area_m2 = piece.invented_area_m2;
    if (piece.base_area_m2 > 0.0)
      object.notes.push_back(
          fmt::format("base closed on the platter over {:.1f} cm^2", piece.base_area_m2 * 1e4));
    fitted.points.insert(fitted.points.end(), object.mesh.vertices.begin(),
                         object.mesh.vertices.end());
    fitted.weights.insert(fitted.weights.end(), piece.support.begin(), piece.support.end());
    out_.objects.push_back(std::move(object));
  }
  return save("fitted", fitted);
}

Result<> Run::merge() {
  TURNSCAN_ASSIGN(merged_, merge_frames(sequence_, recipe_, poses_, context_));
  if (options_.merge.cloud_outliers) {
    TURNSCAN_ASSIGN(const auto keep,
                    statistical_outlier_mask(std::span<const Vec3f>(merged_.cloud.points),
                                             options_.outliers, context_));
    std::size_t kept = 0;
    PointCloud& cloud = merged_.cloud;
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
  }
  out_.frames = merged_.frames;
  out_.dropped_frames = merged_.dropped_frames;
  out_.returns = merged_.returns;
  out_.cropped = merged_.cropped;
  out_.points = merged_.cloud.size();
  if (merged_.cloud.size() < 100)
    return fail(ErrorCode::kTooFewPoints,
                "{} of {} returns are left after crop and filter; check the turntable's place, "
                "--crop-margin and --crop-radius",
                merged_.cloud.size(), merged_.returns);
  return save("merged", merged_.cloud);
}

Result<> Run::count_voxels() {
  // Noise makes neighbouring pixels lie apart; without it they are the spacing of the pixels.
  const double noise = out_.sensor_noise_m, apart = out_.frame_spacing_m;
  const double pixels =
      std::sqrt(std::max(0.25 * apart * apart, apart * apart - 2 * noise * noise));
  const CloudStatistics statistics = cloud_statistics(merged_, 3.0 * std::max(pixels, noise));
  out_.merged_noise_m = std::max(statistics.noise_m, 1e-5);
  cloud_spacing_m_ = statistics.spacing_m;
  double size = std::max(2.0 * statistics.spacing_m, out_.merged_noise_m);
  std::string reason =
      fmt::format("the larger of the thickness of the cloud, {}, and twice its spacing, {}",
                  mm(out_.merged_noise_m), mm(statistics.spacing_m));
  const double longest = bounds(merged_.cloud.points).size().maxCoeff();
  if (options_.voxels.grid) {
    size = longest / *options_.voxels.grid;
    reason = fmt::format("voxel-grid {} along {}", *options_.voxels.grid, mm(longest));
  } else if (size < longest / 2000.0) {
    size = longest / 2000.0;
    reason = fmt::format("a 2000th of the cloud's longest side {}", mm(longest));
  }
  size = length_or(options_.voxels.size_m, "voxel-size", size, reason);
  context_.begin_phase("voxels", 3);
  TURNSCAN_ASSIGN(grid_, VoxelGrid::build(merged_.cloud.points, size, context_));
  context_.advance();
  const ThresholdChoice threshold = choose_min_points(*grid_);
  const int m = options_.voxels.min_points.value_or(threshold.min_points);
  choose("voxel-min-points", std::to_string(m),
         options_.voxels.min_points
             ? "given"
             : fmt::format("a tenth of the typical count {:.0f}", threshold.typical_count));
  grid_->filter(count_filter(*grid_, m));
  context_.advance();
  if (grid_->voxels().empty())
    return fail(ErrorCode::kTooFewPoints,
                "no voxel has {} points (typical are {:.0f}); lower --voxel-min-points", m,
                threshold.typical_count);
  const double gap = length_or(options_.components.gap_m, "object-gap",
                               std::max(3.0 * size, 4.0 * statistics.spacing_m),
                               "the larger of 3 voxels and 4 times the cloud's spacing");
  TURNSCAN_ASSIGN(components_, find_components(*grid_, options_.components,
                                               static_cast<int>(std::lround(gap / size))));
  context_.advance();
  std::vector<std::uint8_t> in_object;
  for (std::int32_t label : components_.label) in_object.push_back(label >= 0 ? 1 : 0);
  grid_->filter(in_object);
  std::erase(components_.label, -1);
  if (components_.crumbs > 0)
    out_.notes.push_back(fmt::format("{} crumbs dropped", components_.crumbs));
  PointCloud centers;
  for (const VoxelGrid::Voxel& voxel : grid_->voxels()) {
    centers.points.push_back(grid_->center(voxel).cast<float>());
    centers.weights.push_back(static_cast<float>(voxel.count()));
  }
  return save("voxels", centers);
}

Result<> Run::choose_candidates() {
  TURNSCAN_ASSIGN(candidates_, find_candidates(merged_, *grid_, options_.candidates, context_));
  out_.objects.resize(components_.voxel_count.size());
  for (std::uint32_t voxel : candidates_.voxel)
    ++out_.objects[std::size_t(components_.label[voxel])].candidates;
  for (std::size_t v = 0; v < grid_->voxels().size(); ++v)
    out_.objects[std::size_t(components_.label[v])].points += grid_->voxels()[v].count();
  return save("candidates", candidates_.cloud);
}

Result<> Run::orient() {
  const double radius = length_or(options_.normals.radius_m, "normal-radius",
                                  std::max(2.5 * grid_->size_m(), 3.0 * out_.merged_noise_m),
                                  "the larger of 2.5 voxels and 3 times the cloud's thickness");
  return estimate_normals(candidates_, radius, context_);
}

Result<> Run::refine() {
  if (!options_.refine.enabled) return save("refined", candidates_.cloud);
  // Enough measurements under the weight that the fitted height is good to a tenth of the noise
  // (a height field of degree 2 has about twice the mean's standard deviation).
  const double size = grid_->size_m(), noise = out_.merged_noise_m;
  const double target = std::max(0.1 * noise, 0.05 * size);
  const double wanted = cloud_spacing_m_ * (2.0 * noise / target) / std::sqrt(4.0 * EIGEN_PI);
  const double radius = length_or(options_.refine.radius_m, "refine-radius",
                                  std::clamp(wanted, 0.75 * size, 3.0 * size),
                                  fmt::format("so that a fitted height is good to {}", mm(target)));
  TURNSCAN_ASSIGN(candidates_, refine_candidates(merged_, *grid_, candidates_, {radius, noise},
                                                 options_.refine.iterations, context_));
  return save("refined", candidates_.cloud);
}

Result<> Run::split_objects() {
  objects_.resize(components_.voxel_count.size());
  const bool colored = options_.color && !candidates_.cloud.colors.empty();
  for (std::size_t i = 0; i < candidates_.cloud.size(); ++i) {
    PointCloud& object = objects_[std::size_t(components_.label[candidates_.voxel[i]])];
    object.points.push_back(candidates_.cloud.points[i]);
    object.normals.push_back(candidates_.cloud.normals[i]);
    object.weights.push_back(candidates_.cloud.weights[i]);
    if (colored) object.colors.push_back(candidates_.cloud.colors[i]);
  }
  PointCloud all;
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    PointCloud& object = objects_[o];
    if (options_.base.enabled && recipe_.cylinder) {
      const double reach = recipe_.cylinder->margin_m + 3.0 * grid_->size_m();
      const BaseResult base = close_base(object, grid_->size_m(), reach);
      object.points.insert(object.points.end(), base.added.points.begin(), base.added.points.end());
      object.normals.insert(object.normals.end(), base.added.normals.begin(),
                            base.added.normals.end());
      object.weights.insert(object.weights.end(), base.added.weights.begin(),
                            base.added.weights.end());
      if (colored)
        object.colors.insert(object.colors.end(), base.added.colors.begin(),
                             base.added.colors.end());
      if (!base.added.empty())
        out_.objects[o].notes.push_back(
            fmt::format("base closed on the platter over {:.1f} cm^2", base.area_m2 * 1e4));
    }
    all.points.insert(all.points.end(), object.points.begin(), object.points.end());
    all.normals.insert(all.normals.end(), object.normals.begin(), object.normals.end());
    if (colored) all.colors.insert(all.colors.end(), object.colors.begin(), object.colors.end());
    out_.objects[o].surface_points = object.size();
  }
  return save("oriented", all);
}

Result<ObjectResult> Run::build_surface(const PointCloud& object) {
  ObjectResult result;
  FinishedMesh finished;
  const double reach = std::max(3.0 * grid_->size_m(), 1.5 * out_.frame_spacing_m);
  if (options_.surface.method == SurfaceMethod::kPoisson) {
    TURNSCAN_ASSIGN(TriangleMesh raw, poisson_surface(object, options_.surface, context_));
    if (options_.surface.repair) {
      TURNSCAN_ASSIGN(finished, finish_poisson(raw, object, reach, context_));
    } else {
      finished.mesh = std::move(raw);
    }
  } else {
    const double alpha = options_.surface.alpha_m.value_or(2.5 * grid_->size_m());
    choose("alpha", mm(alpha), options_.surface.alpha_m ? "given" : "2.5 voxels");
    TURNSCAN_ASSIGN(TriangleMesh raw, concave_hull(object, alpha, context_));
    if (options_.surface.repair) {
      TURNSCAN_ASSIGN(finished,
                      finish_concave_hull(raw, object, 0.8 * grid_->size_m(), reach, context_));
    } else {
      finished.mesh = std::move(raw);
      finished.notes.push_back("a concave hull is not 2-manifold by nature; repair is off");
    }
  }
  if (!options_.surface.repair) finished.check = check_mesh(finished.mesh);
  if (options_.color) color_vertices(finished.mesh, object);
  result.mesh = std::move(finished.mesh);
  result.check = finished.check;
  result.invented_area_m2 = finished.invented_area_m2;
  result.notes = std::move(finished.notes);
  return result;
}

Result<> Run::build_surfaces() {
  context_.begin_phase("surface", objects_.size());
  for (std::size_t o = 0; o < objects_.size(); ++o) {
    auto built = build_surface(objects_[o]);
    if (!built && built.error().code == ErrorCode::kCancelled)
      return tl::unexpected<Error>(built.error());
    if (!built) return fail(built.error().code, "object {}: {}", o + 1, built.error().message);
    ObjectResult& result = out_.objects[o];
    built->points = result.points;
    built->candidates = result.candidates;
    built->surface_points = result.surface_points;
    built->notes.insert(built->notes.begin(), result.notes.begin(), result.notes.end());
    result = std::move(*built);
    result.mesh.name = fmt::format("object {}", o + 1);
    context_.advance();
  }
  return {};
}

}  // namespace

std::vector<StageOptions> describe_stages(ReconstructOptions& o) {
  OptionTable merge = describe(o.merge);
  merge.flag("colour", o.color, "Carry colour to the vertices when the recording has any");
  return {{"crop", describe(o.crop)},
          {"outliers", describe(o.outliers)},
          {"merge", std::move(merge)},
          {"voxels", describe(o.voxels)},
          {"candidates", describe(o.candidates)},
          {"components", describe(o.components)},
          {"normals", describe(o.normals)},
          {"refine", describe(o.refine)},
          {"base", describe(o.base)},
          {"surface", describe(o.surface)},
          {"volumetric", describe(o.volumetric)}};
}

OptionTable describe(ReconstructOptions& options) {
  OptionTable table;
  for (StageOptions& stage : describe_stages(options)) table.append(std::move(stage.table));
  return table;
}

const std::vector<std::string>& saveable_stages() {
  static const std::vector<std::string> stages{"merged",  "voxels",   "candidates",
                                               "refined", "oriented", "fitted"};
  return stages;
}

Result<Reconstruction> reconstruct(const FrameSequence& sequence, const ReconstructOptions& options,
                                   const StageSink& sink, const RunContext& context) {
  ReconstructOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  TURNSCAN_TRY(objects_to_keep(options.components));
  if (options.voxels.size_m && options.voxels.grid)
    return fail(ErrorCode::kInvalidOption, "voxel-size and voxel-grid are both given; give one");
  if (options.surface.method == SurfaceMethod::kVolumetric && options.color)
    return fail(ErrorCode::kInvalidOption,
                "colour: --method volumetric carries none; use --method poisson");
  TURNSCAN_TRY(context.check());
  return Run(sequence, options, sink, context)();
}

}  // namespace turnscan
