#include <algorithm>
#include <cmath>
#include <map>
#include <turnscan/core/median.hpp>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/reconstruction/stage_timer.hpp>
#include <turnscan/reconstruction/texture/camera_refinement.hpp>
#include <turnscan/reconstruction/texture/charts.hpp>
#include <turnscan/reconstruction/texture/color_view.hpp>
#include <turnscan/reconstruction/texture/filling.hpp>
#include <turnscan/reconstruction/texture/smoothed_normals.hpp>
#include <turnscan/reconstruction/texture/texture_objects.hpp>
#include <turnscan/reconstruction/texture/view_turns.hpp>
#include <turnscan/turntable/rotation.hpp>

namespace turnscan::texture {

namespace {

constexpr int kMinSize_px = 256, kMaxSize_px = 4096;  // range of the automatic size
constexpr int kLightRounds = 3;
constexpr int kTurnedRounds = 3;
constexpr double kMinTurned_px = 0.15;  // minimum for reading the images again
constexpr double kMinOfScale = 0.97;
constexpr double kTexelsPerPixel = 2.0;  // so that the texels blur little of the images' detail

double best_pixels_per_m(const std::vector<ColorView>& views, const Vec3f& center) {
  std::vector<double> all;
  for (const ColorView& view : views)
    all.push_back(double(view.focal_px() / (view.eye() - center).norm()));
  return median(all, 1000.0);
}

int rounded_size(double side_px) {
  const int rounded = int(std::min(side_px / 256.0, 1000.0) + 1.0) * 256;
  return std::clamp(rounded, kMinSize_px, kMaxSize_px);
}

/// An atlas of the requested size, which is then fully used, or the smallest that contains the
/// finest useful texels.
Result<Atlas> atlas_for(const TriangleMesh& mesh, const TextureOptions& options,
                        double texels_per_m, const RunContext& context) {
  if (options.size_px)
    return make_atlas(mesh, *options.size_px / kBlock_px * kBlock_px, 1e9, context);
  int size = rounded_size(expected_side_px(mesh, texels_per_m));
  for (;;) {
    TURNSCAN_ASSIGN(Atlas atlas, make_atlas(mesh, size, texels_per_m, context));
    const double share = atlas.texels_per_m / texels_per_m;
    if (share > kMinOfScale || size == kMaxSize_px) return atlas;
    // Charts of this mesh fill less than usual.
    size = std::min(kMaxSize_px, std::max(size + 256, rounded_size(double(size) / share)));
  }
}

/// From the object's frame to that in which lamps are static: the table's at angle 0.
std::vector<Eigen::Matrix3f> rig_rotations(const FrameSequence& sequence,
                                           const std::vector<ColorView>& views) {
  std::vector<Eigen::Matrix3f> out;
  for (const ColorView& view : views) {
    Pose T_rig_object = view.T_sensor_object;
    if (const auto& T = sequence.header().sensors[view.sensor].T_table_sensor)
      T_rig_object = *T * T_rig_object;
    out.push_back(T_rig_object.linear().cast<float>());
  }
  return out;
}

Viewpoints viewpoints_of(const FrameSequence& sequence, const std::vector<ColorView>& views) {
  Viewpoints out{rig_rotations(sequence, views), {}};
  for (const ColorView& view : views) out.eye.push_back(view.eye());
  return out;
}

TextureReport::Highlight noted(const Highlight& highlight) {
  const Vec3f& to_lamp = highlight.direction;
  return {double(std::atan2(-to_lamp.x(), -to_lamp.z())),
          double(std::asin(std::clamp(to_lamp.y(), -1.0f, 1.0f))), double(highlight.strength)};
}

/// The colours under uniform light; negative where the edge of a shadow is near.
BlockMeans without_light(BlockMeans means, const BlockLight& light) {
  for (std::size_t b = 0; b < means.size(); ++b)
    for (std::size_t k = 0; k < kSlots; ++k)
      means[b][k] =
          light[b][k] > 0.0f ? Vec3f(means[b][k] / light[b][k]) : Vec3f(Vec3f::Constant(-1.0f));
  return means;
}

BlockMeans with_gains(BlockMeans means, const ChosenViews& chosen,
                      const std::vector<Vec3f>& gains) {
  for (std::size_t b = 0; b < means.size(); ++b)
    for (std::size_t k = 0; k < kSlots && chosen.view[b][k] != kNoView; ++k)
      means[b][k] = means[b][k].cwiseProduct(gains[chosen.view[b][k]]);
  return means;
}

/// Alternates between light and exposure: a static lamp looks like an exposure that changes with
/// the rotation, and gains estimated without it would hide most of it.
Result<Correction> without_lamp(const LampScene& scene, TexelSamples& samples, double texels_per_m,
                                const RunContext& context) {
  Correction out;
  out.gains.assign(scene.rotation.size(), Vec3f::Ones());
  std::optional<FixedLight> light;
  for (int round = 0; round < kLightRounds; ++round) {
    TURNSCAN_ASSIGN(light, solve_light(scene, out.gains, light, context));
    TURNSCAN_ASSIGN(const BlockLight on_blocks, block_light(scene, *light, context));
    out.gains =
        solve_gains(scene.chosen, without_light(scene.means, on_blocks), scene.rotation.size());
  }
  TURNSCAN_TRY(mark_shadows(scene, *light, samples, context));
  std::vector<Vec3f> to_lamp;
  for (const Eigen::Matrix3f& rotation : scene.rotation)
    to_lamp.push_back(rotation.transpose() * light->direction);
  NormalTilts tilts = shading_normals(scene.blocks, scene.chosen, samples, out.gains, *light,
                                      to_lamp, texels_per_m);
  out.lamp = LampCorrection{*light, std::move(to_lamp), std::move(tilts)};
  return out;
}

/// Estimates the poses of all separate colour cameras, and moves the views there.
Result<> refine_cameras(const FrameSequence& sequence, const TriangleMesh& mesh,
                        std::vector<ColorView>& views, TextureReport& report,
                        const RunContext& context) {
  std::map<std::uint32_t, std::vector<ColorView>> of_sensor;
  for (const ColorView& view : views)
    if (sequence.header().sensors[view.sensor].color_intrinsics)
      of_sensor[view.sensor].push_back(view);
  report.cameras.clear();
  for (const auto& [sensor, own] : of_sensor) {
    const Pose& before = sequence.header().sensors[sensor].T_color_sensor;
    TURNSCAN_ASSIGN(const RefinedCamera found, refine_camera(sequence, mesh, own, before, context));
    const Pose motion = found.T_color_sensor * before.inverse();
    report.cameras.push_back(
        {sensor, found.misplaced_px,
         (found.T_color_sensor.inverse().translation() - before.inverse().translation()).norm(),
         Eigen::AngleAxisd(motion.linear()).angle(), found.deviation_px, found.refined});
    for (ColorView& view : views)
      if (view.sensor == sensor) view.set_pose(found.T_color_sensor);
  }
  return {};
}

/// Rotates the views by the time offset of their images, as long as this improves the alignment of
/// their patterns. The camera's pose, which absorbed these offsets before, is estimated again with
/// the rotated views.
Result<> turn_views(const FrameSequence& sequence, const TriangleMesh& mesh,
                    const TexelBlocks& blocks, const ChosenViews& chosen,
                    std::vector<ColorView>& views, TexelSamples& samples, TextureReport& report,
                    bool refine_camera, const RunContext& context) {
  std::vector<double> turned(views.size(), 0.0);
  for (int round = 0; round < kTurnedRounds; ++round) {
    TURNSCAN_ASSIGN(const std::vector<double> turns,
                    solve_turns(blocks, chosen, samples, views, context));
    if (!(turned_px(turns, views, mesh) > kMinTurned_px)) break;
    const double before = pattern_misfit(blocks, chosen, samples);
    const std::vector<ColorView> old = views;
    const std::vector<TextureReport::Camera> old_cameras = report.cameras;
    for (std::size_t k = 0; k < views.size(); ++k) views[k].turn(turns[k]);
    if (round == 0 && refine_camera)
      TURNSCAN_TRY(refine_cameras(sequence, mesh, views, report, context));
    samples = {};  // frees memory: two of them would exceed its limit
    TURNSCAN_ASSIGN(samples, sample_views(sequence, mesh, blocks, views, chosen, context));
    if (!(pattern_misfit(blocks, chosen, samples) < before)) {
      views = old;
      report.cameras = old_cameras;
      samples = {};
      TURNSCAN_ASSIGN(samples, sample_views(sequence, mesh, blocks, views, chosen, context));
      break;
    }
    for (std::size_t k = 0; k < turned.size(); ++k) turned[k] += turns[k];
    report.turned_rad = turned;
  }
  return {};
}

void note_views(const std::vector<ColorView>& views, const TexelBlocks& blocks,
                const Blended& blended, TextureReport& report) {
  static_assert(kNoView == TextureReport::kNoView);
  for (const ColorView& view : views)
    report.used.push_back({view.position, view.sensor, view.eye()});
  const int side = blocks.size_px() / kBlock_px;
  report.square_px = kBlock_px;
  report.view_of_square = Image<std::uint16_t>(side, side, kNoView);
  for (std::size_t b = 0; b < blocks.count(); ++b)
    report.view_of_square.at(blocks.left(b) / kBlock_px, blocks.top(b) / kBlock_px) =
        blended.main_view[b];
}

}  // namespace

Result<> check_colors(const FrameSequence& sequence) {
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const FrameInfo& info = sequence.frames()[i];
    if (info.status != FrameStatus::kOk || info.sensor >= sequence.header().sensors.size() ||
        sequence.header().sensors[info.sensor].kind != SensorKind::kDepthCamera)
      continue;
    TURNSCAN_ASSIGN(const Frame frame, sequence.read(i));
    if (!frame.color.empty()) return {};
    break;
  }
  return fail(ErrorCode::kMissingData,
              "the frames have no colour images to make a texture from; leave --texture out, or "
              "record colours");
}

Result<TextureReport> texture_mesh(const FrameSequence& sequence, std::vector<ColorView> views,
                                   const TextureOptions& options, TriangleMesh& mesh,
                                   const RunContext& context) {
  TextureReport report;
  const Vec3f center = bounds(mesh.vertices).center().cast<float>();
  views = spread_views(views, center);
  report.views = views.size();
  context.begin_phase("texture", 2 * views.size());
  if (options.refine_camera) TURNSCAN_TRY(refine_cameras(sequence, mesh, views, report, context));
  const double finest = kTexelsPerPixel * best_pixels_per_m(views, center);
  TURNSCAN_ASSIGN(const Atlas atlas, atlas_for(mesh, options, finest, context));
  const std::vector<Vec3f> vertex_normal = smoothed_normals(mesh);
  const TexelBlocks blocks(mesh, atlas, vertex_normal);
  TURNSCAN_ASSIGN(const ChosenViews chosen, choose_views(mesh, blocks, views, context));
  TURNSCAN_ASSIGN(TexelSamples samples,
                  sample_views(sequence, mesh, blocks, views, chosen, context));
  TURNSCAN_TRY(turn_views(sequence, mesh, blocks, chosen, views, samples, report,
                          options.refine_camera, context));
  BlockMeans means = block_means(blocks, chosen, samples);
  Correction correction;
  // With a removed lamp, levels would compensate its shadows.
  if (options.albedo) {
    TURNSCAN_ASSIGN(const TriangleMesh coarse, coarse_caster(mesh));
    const LampScene scene{mesh, coarse, blocks, chosen, means, rig_rotations(sequence, views)};
    TURNSCAN_ASSIGN(correction, without_lamp(scene, samples, atlas.texels_per_m, context));
  } else {
    correction.gains = solve_gains(chosen, means, views.size());
    const Viewpoints viewpoints = viewpoints_of(sequence, views);
    TURNSCAN_ASSIGN(const auto highlight,
                    solve_highlight(blocks, chosen, with_gains(means, chosen, correction.gains),
                                    viewpoints, context));
    if (highlight) {
      correction.highlight.emplace(*highlight, viewpoints);
      report.highlight = noted(*highlight);
      means = without_highlight(std::move(means), blocks, chosen, *correction.highlight,
                                correction.gains);
      correction.gains = solve_gains(chosen, means, views.size());
    }
    correction.levels = seam_levels(
        blocks, chosen, with_gains(std::move(means), chosen, correction.gains), views.size());
  }
  report.albedo = options.albedo;
  TURNSCAN_ASSIGN(const Blended blended,
                  blend(blocks, chosen, samples, correction, atlas.texels_per_m, context));
  auto texture = std::make_shared<MeshTexture>();
  texture->image = filled_picture(mesh, blocks, blended);
  texture->corners = atlas.corners;
  for (auto& corners : texture->corners)
    for (Eigen::Vector2f& corner : corners) corner /= float(atlas.size_px);
  mesh.texture = std::move(texture);
  report.size_px = atlas.size_px;
  report.texel_m = 1.0 / atlas.texels_per_m;
  report.charts = atlas.charts;
  report.stretch = atlas.stretch;
  report.filled_share = filled_share(blocks, blended);
  report.one_view_share = blended.one_view_share;
  report.disagreement_px = blended.disagreement_px;
  report.gains = correction.gains;
  note_views(views, blocks, blended, report);
  return report;
}

Result<> texture_objects(const FrameSequence& sequence, const ReconstructOptions& options,
                         const std::vector<PassPlacement>& passes, Reconstruction& reconstruction,
                         const RunContext& context) {
  const StageTimer timer(reconstruction.stages, "texture");
  TURNSCAN_ASSIGN(const FramePoses poses,
                  frame_poses(sequence.header(), sequence.frames(), options.merge.speed_rad_s));
  std::vector<Pose> T_object_table;
  for (const PassPlacement& pass : passes) T_object_table.push_back(pass.T_object_table);
  const auto views =
      color_views(sequence, poses.T_table_sensor, T_object_table, options.merge.chosen_pass());
  for (ObjectResult& object : reconstruction.objects) {
    TURNSCAN_ASSIGN(object.texture,
                    texture_mesh(sequence, views, options.texture, object.mesh, context));
  }
  return {};
}

}  // namespace turnscan::texture
