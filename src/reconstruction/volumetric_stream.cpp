#include <algorithm>
#include <turnscan/reconstruction/scan_statistics.hpp>
#include <turnscan/reconstruction/sensor_filter.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/volumetric_stream.hpp>

namespace turnscan {

namespace {

/// Views that are summed together, brick by brick. Always so many, however they come.
constexpr std::size_t kBatch = 16;
/// At the end the noise may turn out to be so much larger than at first sight.
constexpr double kNoiseSlack = 1.3;
constexpr std::size_t kPreviewBricks = 4000;

std::size_t bytes_of(const DepthView& view) {
  return view.pixels.size() * sizeof(view.pixels[0]) + view.colors.size() * sizeof(Rgb);
}

/// Where the frames' places disagree, the cloud is thicker than one frame's noise. 0 when there
/// are too few points to tell.
double thickness(const VolumetricInput& input, double noise_m) {
  MergedCloud sample;
  sample.cloud.points = sample_points(input);
  if (sample.cloud.size() < 100) return 0.0;
  return cloud_statistics(sample, 3.0 * std::max(input.spacing_m, noise_m)).noise_m;
}

}  // namespace

void ViewStore::add(DepthView view, std::uint32_t sensor) {
  if (seen_.size() <= sensor) seen_.resize(std::size_t(sensor) + 1, 0);
  const std::uint32_t number = seen_[sensor]++;
  if (number % stride_ != 0) return;
  bytes_ += bytes_of(view);
  views_.push_back(std::move(view));
  key_.emplace_back(sensor, number);
  while (views_.size() > kMostViews || (bytes_ > kMostBytes && views_.size() > kFewViews)) thin();
}

void ViewStore::thin() {
  stride_ *= 2;
  std::size_t kept = 0;
  bytes_ = 0;
  for (std::size_t v = 0; v < views_.size(); ++v) {
    if (key_[v].second % stride_ != 0) continue;
    bytes_ += bytes_of(views_[v]);
    if (kept != v) views_[kept] = std::move(views_[v]);
    key_[kept++] = key_[v];
  }
  views_.resize(kept);
  key_.resize(kept);
}

Result<std::unique_ptr<VolumetricStream>> VolumetricStream::create(
    const SequenceHeader& header, const ReconstructOptions& options, const FirstLook& look,
    const std::vector<RayTable>& rays) {
  std::unique_ptr<VolumetricStream> stream(new VolumetricStream(header, options, rays));
  const double noise = look.noise_m, apart = look.even_spacing_m;
  VolumetricInput& input = stream->input_;
  stream->sensor_noise_m_ = input.noise_m = noise;
  // Noise makes neighbouring pixels lie apart; without it they are the spacing of the pixels.
  input.spacing_m = std::sqrt(std::max(0.25 * apart * apart, apart * apart - 2 * noise * noise));
  const auto& sensors = header.sensors;
  if (std::all_of(sensors.begin(), sensors.end(),
                  [](const SensorInfo& s) { return s.kind == SensorKind::kPointScanner; }))
    input.cells_of_spacing = 0.9;
  stream->are_images_ = std::all_of(sensors.begin(), sensors.end(), [](const SensorInfo& s) {
    return s.kind == SensorKind::kDepthCamera;
  });
  input.profiles = look.profiles;
  input.cylinder = look.cylinder;
  input.cell_m = options.voxels.size_m;
  input.grid = options.voxels.grid;
  TURNSCAN_ASSIGN(input.keep, objects_to_keep(options.components));
  stream->view_scale_ = {std::max(8.0 * noise, 4.0 * input.spacing_m), input.spacing_m,
                         options.color};
  input.colored = options.color;
  return stream;
}

Result<DepthView> VolumetricStream::view(const Frame& frame, const Pose& T_table_sensor) const {
  std::optional<SensorCrop> crop;
  if (input_.cylinder) crop.emplace(*input_.cylinder, T_table_sensor);
  const std::size_t s = frame.info.sensor;
  return make_view(frame, header_->sensors.at(s), rays_->at(s), T_table_sensor, view_scale_,
                   [&](const Vec3f& p) { return !crop || crop->keeps(p); });
}

Result<> VolumetricStream::add(DepthView view, std::uint32_t sensor) {
  if (view.empty()) return {};
  pending_.push_back(std::move(view));
  pending_sensor_.push_back(sensor);
  return begun_ ? accumulate(false) : Result<>();
}

Result<> VolumetricStream::begin() {
  input_.views = std::move(pending_);
  if (are_images_) input_.filter_share = share_of_neighbours(input_.views, sensor_noise_m_);
  input_.noise_m = std::max(sensor_noise_m_, thickness(input_, sensor_noise_m_));
  scale_ = choose_scale(input_, options_.volumetric, measured_box(input_));
  pending_ = std::move(input_.views);
  {
    const std::lock_guard lock(mutex_);
    sums_ = FieldSums(scale_.volume);
  }
  begun_ = true;
  return accumulate(false);
}

/// Sums up the whole batches of what is pending, or all of it.
Result<> VolumetricStream::accumulate(bool all) {
  std::size_t done = 0;
  while (done + (all ? 1 : kBatch) <= pending_.size()) {
    const std::size_t count = std::min(kBatch, pending_.size() - done);
    {
      const std::lock_guard lock(mutex_);
      TURNSCAN_TRY(sums_.add(std::span(pending_).subspan(done, count),
                             {kept_.views(), float(kept_.stride())}));
    }
    for (std::size_t v = done; v < done + count; ++v)
      kept_.add(std::move(pending_[v]), pending_sensor_[v]);
    done += count;
  }
  pending_.erase(pending_.begin(), pending_.begin() + std::ptrdiff_t(done));
  pending_sensor_.erase(pending_sensor_.begin(), pending_sensor_.begin() + std::ptrdiff_t(done));
  return {};
}

/// When the frames' places disagree more than the first ones let expect, the volume is made once
/// more, from the views that were kept.
Result<> VolumetricStream::correct_noise(Reconstruction& out) {
  out.merged_noise_m = thickness(input_, sensor_noise_m_);
  const double noise = std::max(sensor_noise_m_, out.merged_noise_m);
  const bool again = noise > kNoiseSlack * input_.noise_m && !options_.volumetric.truncation_m;
  input_.noise_m = noise;
  if (!again) return {};
  out.notes.push_back(
      fmt::format("the frames' places disagree by {}, which the first frames did not show: the "
                  "volume was made again",
                  format_quantity(noise, Quantity::kLength)));
  scale_ = choose_scale(input_, options_.volumetric, measured_box(input_));
  FieldSums sums(scale_.volume);
  const std::span<const DepthView> all(input_.views);
  for (std::size_t v = 0; v < all.size(); v += kBatch)
    TURNSCAN_TRY(sums.add(all.subspan(v, std::min(kBatch, all.size() - v)), {all.first(v), 1.0f}));
  const std::lock_guard lock(mutex_);
  sums_ = std::move(sums);
  return {};
}

Result<TriangleMesh> VolumetricStream::preview(const RunContext& context) const {
  Volume volume;
  VolumeScale scale;
  {
    const std::lock_guard lock(mutex_);
    volume = sums_.settle_coarsely(kPreviewBricks);
    scale = sums_.scale();
  }
  if (volume.brick_count() == 0) return TriangleMesh();
  scale.cell_m = volume.cell_m;
  scale.truncation_m = volume.truncation_m;
  close_volume(volume, scale, context);
  TURNSCAN_TRY(context.check());
  TURNSCAN_ASSIGN(const BrickGrid grid, to_grid(volume, std::size_t(1) << 30));
  return isosurface(grid, IsosurfaceOptions(), context);
}

Result<> VolumetricStream::finish(const StageSink& sink, const RunContext& context,
                                  Reconstruction& out) {
  out.points = out.cropped;
  if (out.cropped < 100)
    return fail(ErrorCode::kTooFewPoints,
                "{} of {} returns are left after the crop; check the turntable's place, "
                "--crop-margin and --crop-radius",
                out.cropped, out.returns);
  {
    const StageTimer timer(out, "frames");
    TURNSCAN_TRY(accumulate(true));
  }
  TURNSCAN_TRY(context.check());
  if (options_.volumetric.sharpen && input_.filter_share > 0.0)
    out.notes.push_back(fmt::format(
        "the sensor averages over pixels, {:.0f} % of a depth are its row's neighbours': "
        "edges are sharpened",
        200.0 * input_.filter_share));
  input_.views = kept_.take();
  {
    const StageTimer timer(out, "noise");
    TURNSCAN_TRY(correct_noise(out));
  }
  TURNSCAN_ASSIGN(VolumetricResult result,
                  reconstruct_volume(input_, scale_, sums_, options_.volumetric,
                                     options_.components.min_share, context));
  for (const VolumetricChoice& c : scale_.choices)
    out.choices.push_back({c.option, c.value, c.reason, -1});
  for (const auto& [name, seconds] : result.seconds) out.stages.push_back({name, seconds});
  const StageTimer timer(out, "check");
  PointCloud fitted;
  for (VolumetricPiece& piece : result.pieces) {
    ObjectResult object;
    object.mesh = std::move(piece.mesh);
    object.mesh.name = fmt::format("object {}", out.objects.size() + 1);
    object.check = check_mesh(object.mesh);
    object.points = piece.points;
    object.invented_area_m2 = piece.invented_area_m2;
    object.confidence = std::move(piece.confidence);
    if (options_.color && object.mesh.colors.empty())
      object.notes.emplace_back("the recording has no colour");
    if (piece.base_area_m2 > 0.0)
      object.notes.push_back(
          fmt::format("base closed on the platter over {:.1f} cm^2", piece.base_area_m2 * 1e4));
    if (piece.hanging > 0)
      object.notes.push_back(
          fmt::format("{} part{} of it hang{} in the air: no frame shows what "
                      "connects them to the rest",
                      piece.hanging, piece.hanging == 1 ? "" : "s", piece.hanging == 1 ? "s" : ""));
    fitted.points.insert(fitted.points.end(), object.mesh.vertices.begin(),
                         object.mesh.vertices.end());
    fitted.weights.insert(fitted.weights.end(), piece.support.begin(), piece.support.end());
    out.objects.push_back(std::move(object));
  }
  return sink ? sink("fitted", fitted) : Result<>();
}

}  // namespace turnscan
