#include <algorithm>
#include <turnscan/reconstruction/scan_statistics.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/volumetric_stream.hpp>

namespace turnscan {

Result<VolumetricStream> VolumetricStream::create(const SequenceHeader& header,
                                                  const ReconstructOptions& options,
                                                  const FirstLook& look,
                                                  const std::vector<RayTable>& rays) {
  VolumetricStream stream(header, options, rays);
  const double noise = look.noise_m, apart = look.spacing_m;
  VolumetricInput& input = stream.input_;
  input.noise_m = noise;
  // Noise makes neighbouring pixels lie apart; without it they are the spacing of the pixels.
  input.spacing_m = std::sqrt(std::max(0.25 * apart * apart, apart * apart - 2 * noise * noise));
  input.cylinder = look.cylinder;
  input.cell_m = options.voxels.size_m;
  input.grid = options.voxels.grid;
  TURNSCAN_ASSIGN(input.keep, objects_to_keep(options.components));
  stream.view_scale_ = {std::max(8.0 * noise, 4.0 * input.spacing_m), input.spacing_m};
  return stream;
}

Result<DepthView> VolumetricStream::view(const Frame& frame, const Pose& T_table_sensor) const {
  std::optional<SensorCrop> crop;
  if (input_.cylinder) crop.emplace(*input_.cylinder, T_table_sensor);
  const std::size_t s = frame.info.sensor;
  return make_view(frame, header_->sensors.at(s), rays_->at(s), T_table_sensor, view_scale_,
                   [&](const Vec3f& p) { return !crop || crop->keeps(p); });
}

Result<> VolumetricStream::add(DepthView view) {
  if (!view.empty()) input_.views.push_back(std::move(view));
  return {};
}

/// Where the frames' places disagree, the cloud is thicker than one frame's noise.
void VolumetricStream::measure_thickness(Reconstruction& out) {
  MergedCloud sample;
  sample.cloud.points = sample_points(input_);
  if (sample.cloud.size() < 100) return;
  const auto start = 3.0 * std::max(input_.spacing_m, input_.noise_m);
  out.merged_noise_m = cloud_statistics(sample, start).noise_m;
  input_.noise_m = std::max(input_.noise_m, out.merged_noise_m);
}

Result<> VolumetricStream::finish(const StageSink& sink, const RunContext& context,
                                  Reconstruction& out) {
  out.points = out.cropped;
  if (out.cropped < 100)
    return fail(ErrorCode::kTooFewPoints,
                "{} of {} returns are left after the crop; check the turntable's place, "
                "--crop-margin and --crop-radius",
                out.cropped, out.returns);
  measure_thickness(out);
  TURNSCAN_ASSIGN(
      VolumetricResult result,
      reconstruct_volume(input_, options_.volumetric, options_.components.min_share, context));
  for (const VolumetricChoice& c : result.choices)
    out.choices.push_back({c.option, c.value, c.reason, -1});
  for (const auto& [name, seconds] : result.seconds) out.stages.push_back({name, seconds});
  PointCloud fitted;
  for (VolumetricPiece& piece : result.pieces) {
    ObjectResult object;
    object.mesh = std::move(piece.mesh);
    object.mesh.name = fmt::format("object {}", out.objects.size() + 1);
    object.check = check_mesh(object.mesh);
    object.points = piece.points;
    object.invented_area_m2 = piece.invented_area_m2;
    if (piece.base_area_m2 > 0.0)
      object.notes.push_back(
          fmt::format("base closed on the platter over {:.1f} cm^2", piece.base_area_m2 * 1e4));
    fitted.points.insert(fitted.points.end(), object.mesh.vertices.begin(),
                         object.mesh.vertices.end());
    fitted.weights.insert(fitted.weights.end(), piece.support.begin(), piece.support.end());
    out.objects.push_back(std::move(object));
  }
  return sink ? sink("fitted", fitted) : Result<>();
}

}  // namespace turnscan
