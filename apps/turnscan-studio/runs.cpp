#include "runs.hpp"

#include <algorithm>
#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/closest_point.hpp>
#include <turnscan/geometry/sample.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/rotation.hpp>

#include "calibration_choice.hpp"
#include "cloud_sequence.hpp"
#include "evaluation_text.hpp"
#include "reconstruction_text.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kBins = 48;
constexpr std::size_t kHistogramSamples = 60000;

/// The cloud of one stage; the pipeline is stopped when it is there.
struct StageCatch {
  std::string wanted;
  PointCloud cloud;
  bool caught = false;

  StageSink sink() {
    return [this](const std::string& stage, const PointCloud& made) -> Result<> {
      if (stage != wanted) return {};
      cloud = made;
      caught = true;
      return fail(ErrorCode::kCancelled, "the stage is done");
    };
  }
};

std::vector<Viewpoint> viewpoints_of(const FrameSequence& sequence,
                                     const std::optional<double>& speed_rad_s) {
  std::vector<Viewpoint> out;
  const auto poses = frame_poses(sequence.header(), sequence.frames(), speed_rad_s);
  if (!poses) return out;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const SensorInfo& sensor = sequence.header().sensors[sequence.frames()[i].sensor];
    out.push_back(sensor.viewpoint.transformed(poses->T_table_sensor[i]));
  }
  return out;
}

/// The clouds of these stages are made on the way to a surface by points.
bool of_points(const std::string& stage) { return stage != kMeshStage && stage != "fitted"; }

Result<StageRun> run_on(const FrameSequence& frames, const Model& model, const std::string& stage,
                        ReconstructOptions options, const std::string& note,
                        const RunContext& context) {
  StageRun out;
  if (of_points(stage) && options.surface.method == SurfaceMethod::kVolumetric)
    options.surface.method = SurfaceMethod::kPoisson;
  options.keep_points = stage == "merged";
  StageCatch caught{stage, {}, false};
  auto result = reconstruct(frames, options, caught.sink(), context);
  const QString source = QObject::tr("%1 of %2").arg(QString::fromStdString(stage), model.name);
  if (caught.caught) {
    const bool has_frames = caught.cloud.frame.size() == caught.cloud.size();
    auto viewpoints =
        has_frames ? viewpoints_of(frames, options.merge.speed_rad_s) : std::vector<Viewpoint>();
    context.begin_phase("prepare the view", 0);
    out.models.emplace_back(QString("%1 %2").arg(model.name, QString::fromStdString(stage)),
                            cloud_model(std::move(caught.cloud), source,
                                        QString::fromStdString(note), std::move(viewpoints)));
    return out;
  }
  if (!result) return tl::unexpected<Error>(std::move(result).error());
  if (stage != kMeshStage)
    return fail(ErrorCode::kUnsupported,
                "the stage {} is not a part of this method; choose another method", stage);
  if (!note.empty()) result->notes.insert(result->notes.begin(), note);
  if (options.surface.repair) TURNSCAN_TRY(cli::check_watertight(*result));
  const QString report = QString::fromStdString(cli::reconstruction_text(*result));
  context.begin_phase("prepare the view", result->objects.size());
  for (ObjectResult& object : result->objects) {
    const QString name =
        result->objects.size() == 1
            ? QObject::tr("%1 mesh").arg(model.name)
            : QObject::tr("%1 %2").arg(model.name, QString::fromStdString(object.mesh.name));
    out.models.emplace_back(
        name, mesh_model(std::move(object.mesh), source, report, std::move(object.confidence)));
    context.advance();
  }
  out.choices = std::move(result->choices);
  return out;
}

Result<StageRun> run_recording(const Model& model, const std::string& stage,
                               ReconstructOptions options, const RunContext& context) {
  const Recording& recording = *model.data->recording;
  TURNSCAN_ASSIGN(
      const cli::CalibrationChoice choice,
      cli::choose_calibration(recording, {"auto", options.merge.speed_rad_s, false}, context));
  TURNSCAN_ASSIGN(const auto frames, cli::with_choice(recording, choice));
  if (choice.calibration) options.merge.speed_rad_s.reset();  // it is in the angles
  TURNSCAN_ASSIGN(StageRun run,
                  run_on(*frames, model, stage, std::move(options), choice.note, context));
  // Frames that are damaged, too: what was left out is told with what was made.
  if (recording.notes().empty()) return run;
  QString notes;
  for (const std::string& note : recording.notes())
    notes += QObject::tr("\nNote: %1").arg(QString::fromStdString(note));
  for (auto& [name, data] : run.models) {
    auto told = std::make_shared<ModelData>(*data);
    told->report += notes;
    data = std::move(told);
  }
  return run;
}

Result<StageRun> run_cloud(const Model& model, const std::string& stage, ReconstructOptions options,
                           const RunContext& context) {
  std::string note;
  if (options.surface.method == SurfaceMethod::kVolumetric) {
    options.surface.method = SurfaceMethod::kPoisson;
    note = "method volumetric needs the frames of a recording; a cloud takes poisson";
  }
  options.crop.enabled = false;
  options.outliers.enabled = options.merge.cloud_outliers;
  options.base.enabled = false;
  const auto frames = sequence_of(model.data->cloud, model.data->viewpoints);
  return run_on(*frames, model, stage, std::move(options), note, context);
}

/// Area-uniform points of a mesh, or the points of a cloud, thinned.
Result<std::vector<Vec3f>> probe(const ModelData& data, const RunContext& context) {
  if (data.kind == ModelKind::kMesh) {
    TURNSCAN_ASSIGN(SurfaceSamples samples,
                    sample_surface(data.mesh, kHistogramSamples, 1, context));
    return std::move(samples.points);
  }
  std::vector<Vec3f> out;
  const std::size_t step = std::max<std::size_t>(1, data.cloud.size() / kHistogramSamples);
  for (std::size_t i = 0; i < data.cloud.size(); i += step) out.push_back(data.cloud.points[i]);
  return out;
}

std::vector<float> distances_of(const std::vector<Vec3f>& points, const MeshDistance& reference) {
  std::vector<float> out(points.size());
  parallel_for(points.size(), 1024, [&](std::size_t i) {
    out[i] = static_cast<float>(reference.closest(points[i].cast<double>()).distance);
  });
  return out;
}

/// Viridis at five places (Smith and van der Walt 2015), blended between them.
Rgb viridis(double share) {
  static constexpr std::array<std::array<int, 3>, 5> anchors{
      {{68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 201, 98}, {253, 231, 37}}};
  const double at = 4.0 * std::clamp(share, 0.0, 1.0);
  const auto low = std::min<std::size_t>(3, static_cast<std::size_t>(at));
  const double t = at - double(low);
  const auto mix = [&](std::size_t c) {
    return static_cast<std::uint8_t>(
        std::lround((1 - t) * anchors[low][c] + t * anchors[low + 1][c]));
  };
  return {mix(0), mix(1), mix(2)};
}

Result<ModelDataPtr> colored_by_distance(const ModelData& compared, const ModelData& reference,
                                         const MeshDistance& distance, double scale_m,
                                         const QString& report, const RunContext& context) {
  const QString source = QObject::tr("distance to %1").arg(reference.source);
  if (compared.kind == ModelKind::kMesh) {
    TriangleMesh mesh = compared.mesh;
    mesh.normals.clear();
    TURNSCAN_ASSIGN(TriangleMesh colored, color_by_error(mesh, reference.mesh, scale_m, context));
    return mesh_model(std::move(colored), source, report);
  }
  PointCloud cloud = compared.cloud;
  const std::vector<float> away = distances_of(cloud.points, distance);
  TURNSCAN_TRY(context.check());
  cloud.colors.clear();
  for (const float d : away) cloud.colors.push_back(viridis(d / scale_m));
  return cloud_model(std::move(cloud), source, report);
}

}  // namespace

Result<StageRun> run_stage_of(const Model& model, const std::string& stage,
                              const ReconstructOptions& options, const RunContext& context) {
  switch (model.data->kind) {
    case ModelKind::kRecording:
      return run_recording(model, stage, options, context);
    case ModelKind::kCloud:
      return run_cloud(model, stage, options, context);
    case ModelKind::kMesh:
      break;
  }
  return fail(ErrorCode::kUnsupported, "'{}' is a mesh already; select a recording or a cloud",
              model.name.toStdString());
}

Result<ModelDataPtr> filter_cloud(const Model& model, const OutlierOptions& options,
                                  const RunContext& context) {
  if (model.data->kind != ModelKind::kCloud)
    return fail(ErrorCode::kUnsupported,
                "'{}' is not a cloud; the frames of a recording are filtered when it is merged",
                model.name.toStdString());
  const PointCloud& from = model.data->cloud;
  context.begin_phase("filter", 0);
  TURNSCAN_ASSIGN(const auto keep,
                  statistical_outlier_mask(std::span<const Vec3f>(from.points), options, context));
  PointCloud kept;
  for (std::size_t i = 0; i < keep.size(); ++i) {
    if (keep[i] == 0) continue;
    kept.points.push_back(from.points[i]);
    if (!from.normals.empty()) kept.normals.push_back(from.normals[i]);
    if (!from.colors.empty()) kept.colors.push_back(from.colors[i]);
    if (!from.weights.empty()) kept.weights.push_back(from.weights[i]);
    if (!from.frame.empty()) kept.frame.push_back(from.frame[i]);
  }
  context.begin_phase("prepare the view", 0);
  const QString report = QObject::tr("%1 of %2 points were dropped")
                             .arg(grouped(from.size() - kept.size()), grouped(from.size()));
  return cloud_model(std::move(kept), QObject::tr("filter of %1").arg(model.name), report,
                     model.data->viewpoints);
}

Result<Comparison> compare(const ModelData& compared, const ModelData& reference,
                           const EvaluateOptions& options, double scale_m,
                           const RunContext& context) {
  if (reference.kind != ModelKind::kMesh)
    return fail(ErrorCode::kUnsupported, "distances are to a mesh; choose one as the reference");
  if (compared.kind == ModelKind::kRecording)
    return fail(ErrorCode::kUnsupported, "a recording has no surface yet; reconstruct it first");
  Comparison out;
  TURNSCAN_ASSIGN(const auto thresholds, parse_thresholds(options.thresholds));
  out.scale_m = scale_m > 0.0 ? scale_m : thresholds.back();
  if (compared.kind == ModelKind::kMesh) {
    TURNSCAN_ASSIGN(out.figures, evaluate(compared.mesh, reference.mesh, options, {}, context));
  }
  const QString report =
      out.figures ? QString::fromStdString(cli::evaluation_text(*out.figures)) : QString();
  context.begin_phase("distances", 0);
  const MeshDistance distance(reference.mesh);
  TURNSCAN_ASSIGN(const auto points, probe(compared, context));
  TURNSCAN_TRY(context.check());
  const std::vector<float> away = distances_of(points, distance);
  out.histogram.assign(kBins, 0.0);
  for (const float d : away) {
    const double at = std::min(double(d) / out.scale_m, 1.0) * double(kBins);
    out.histogram[std::min(kBins - 1, static_cast<std::size_t>(at))] += 1.0 / double(away.size());
  }
  TURNSCAN_ASSIGN(out.colored,
                  colored_by_distance(compared, reference, distance, out.scale_m, report, context));
  return out;
}

}  // namespace turnscan::studio
