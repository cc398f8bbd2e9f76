#include "explorer/stage_runs.hpp"

#include <QDir>
#include <QFileInfo>
#include <optional>
#include <turnscan/reconstruction/outliers/outliers.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/mesh_output.hpp>
#include <turnscan/workflow/next_pass/next_pass_text.hpp>
#include <turnscan/workflow/progress/phase_plans.hpp>
#include <turnscan/workflow/reconstruct_run.hpp>
#include <turnscan/workflow/text/reconstruction_text.hpp>
#include <variant>

#include "explorer/cloud_sequence.hpp"
#include "explorer/editing/edits.hpp"
#include "explorer/passes/pass_meshes.hpp"
#include "explorer/reconstruct_until.hpp"
#include "explorer/scan_quality.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace {

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

QString source_of(const std::string& stage, const Model& model) {
  return QObject::tr("%1 of %2").arg(QString::fromStdString(stage), model.name);
}

/// Whether the stage's cloud is made by the point-based methods.
bool of_points(const std::string& stage) { return stage != kMeshStage && stage != "fitted"; }

StageRun cloud_run(PointCloud cloud, const FrameSequence& frames, const Model& model,
                   const std::string& stage, const std::optional<double>& speed_rad_s,
                   const std::string& note, const RunContext& context) {
  const bool has_frames = cloud.frame.size() == cloud.size();
  auto viewpoints = has_frames ? viewpoints_of(frames, speed_rad_s) : std::vector<Viewpoint>();
  context.begin_phase("prepare the view", 0);
  StageRun out;
  out.models.emplace_back(QString("%1 %2").arg(model.name, QString::fromStdString(stage)),
                          cloud_model(std::move(cloud), source_of(stage, model),
                                      QString::fromStdString(note), std::move(viewpoints)));
  return out;
}

/// The unseen surface, slightly offset outward so that it covers the mesh.
DrawablePtr unseen_drawable(const ObjectResult& object) {
  constexpr float kOutside_m = 0.0002f;
  TriangleMesh unseen;
  const TriangleMesh& mesh = object.mesh;
  for (std::size_t i = 0; i < object.evidence.size(); ++i) {
    if (object.evidence[i] != Evidence::kInvented && object.evidence[i] != Evidence::kBase)
      continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3f normal = (mesh.vertices[b] - mesh.vertices[a])
                             .cross(mesh.vertices[c] - mesh.vertices[a])
                             .normalized();
    const auto first = std::uint32_t(unseen.vertices.size());
    for (const std::uint32_t v : {a, b, c}) {
      unseen.vertices.push_back(mesh.vertices[v] + kOutside_m * normal);
      unseen.normals.push_back(normal);
    }
    unseen.triangles.push_back({first, first + 1, first + 2});
  }
  return unseen.empty() ? nullptr : make_drawable(unseen, Shading::kFlat);
}

/// For the largest object of a run on a recording.
std::shared_ptr<const MissingSurface> missing_of(const ReconstructRun& run, const Model& model) {
  auto out = std::make_shared<MissingSurface>();
  // A pass can be added to a recording, but not to a file of another program.
  const bool is_recording = QFileInfo(QDir(model.data->source).filePath("recording.json")).exists();
  if (is_recording) out->side.recording = model.data->source;
  if (!run.next_pass) {
    out->side.advice = QObject::tr("Nearly all of its surface was seen.");
    return out;
  }
  out->side.advice = QString::fromStdString(next_pass_text(*run.next_pass)).replace("cm2", "cm²");
  if (!run.next_pass->poses.empty())
    out->side.turn = ObjectTurn{turn_seen_by_sensor(run.next_pass->poses.front(), run.seen_from),
                                run.seen_from.first_time_s};
  out->drawable = unseen_drawable(run.reconstruction.objects.front());
  return out;
}

/// Properties of meshes besides their shape.
struct MeshOrigin {
  std::shared_ptr<const PageInput> page;
  std::size_t first_of_page = 0;
  std::shared_ptr<const MissingSurface> missing;  // of the first
  std::vector<PassesPtr> passes;                  // one each, or none
  std::vector<std::size_t> left_out;              // frames, of all
};

StageRun mesh_run(Reconstruction result, const Model& model, const RunContext& context,
                  const MeshOrigin& origin = {}) {
  StageRun out;
  const QString report = QString::fromStdString(reconstruction_text(result));
  context.begin_phase("prepare the view", result.objects.size());
  for (ObjectResult& object : result.objects) {
    const QString name =
        result.objects.size() == 1
            ? QObject::tr("%1 mesh").arg(model.name)
            : QObject::tr("%1 %2").arg(model.name, QString::fromStdString(object.mesh.name));
    const ModelDataPtr made = mesh_model(std::move(object.mesh), source_of(kMeshStage, model),
                                         report, std::move(object.confidence));
    auto data = std::make_shared<ModelData>(*made);
    const std::size_t number = out.models.size();
    if (number == 0) data->missing = origin.missing;
    data->left_out = origin.left_out;
    if (number < origin.passes.size()) data->passes = origin.passes[number];
    if (origin.page && object.verdict)
      data->quality = std::make_shared<ScanQuality>(ScanQuality{
          *object.verdict, origin.page, origin.first_of_page + number,
          object.texture ? std::make_shared<const TextureReport>(*object.texture) : nullptr});
    out.models.emplace_back(name, std::move(data));
    context.advance();
  }
  out.choices = std::move(result.choices);
  return out;
}

/// Meshes of a recording are those of the command line: its passes are joined.
Result<StageRun> mesh_of_recording(const Model& model, const ReconstructOptions& options,
                                   const std::vector<PassPose>& poses, const RunContext& context) {
  ReconstructRequest request;
  request.options = options;
  request.pass_poses = poses;
  request.allow_open = !options.surface.repair;
  TURNSCAN_ASSIGN(ReconstructRun made,
                  run_reconstruction(*model.data->recording, request, context));
  const bool any = !made.reconstruction.objects.empty();
  const auto page = std::make_shared<const PageInput>(
      page_input(made, run_report(made, options), model.name.toStdString()));
  std::size_t on_page = made.reconstruction.objects.size();
  const MeshOrigin origin{
      page, 0, any ? missing_of(made, model) : nullptr,
      passes_of_meshes(model.data, made.reconstruction, options.merge.chosen_pass()),
      made.choice.left_out};
  StageRun out = mesh_run(std::move(made.reconstruction), model, context, origin);
  QStringList reasons;
  for (PassApart& pass : made.apart) {
    const std::size_t objects = pass.reconstruction.objects.size();
    const auto passes = passes_of_meshes(model.data, pass.reconstruction, pass.number);
    StageRun apart = mesh_run(std::move(pass.reconstruction), model, context,
                              {page, on_page, nullptr, passes, made.choice.left_out});
    on_page += objects;
    for (auto& [name, data] : apart.models)
      out.models.emplace_back(QObject::tr("%1 of %2").arg(name, QString::fromStdString(pass.name)),
                              std::move(data));
    if (!pass.reason.empty())
      reasons << QObject::tr("%1 was not joined: %2; its mesh is a model of its own")
                     .arg(QString::fromStdString(pass.name), QString::fromStdString(pass.reason));
  }
  out.not_joined = reasons.join("\n");
  if (out.models.empty())
    return fail(ErrorCode::kTooFewPoints, "no pass of '{}' shows an object; look at its frames",
                model.name.toStdString());
  return out;
}

Result<StageRun> run_on(const FrameSequence& frames, const Model& model, const std::string& stage,
                        ReconstructOptions options, const std::string& note,
                        const RunContext& context) {
  if (of_points(stage) && options.surface.method == SurfaceMethod::kVolumetric)
    options.surface.method = SurfaceMethod::kPoisson;
  options.keep_points = stage == "merged";
  if (stage == "sub-voxels") options.candidates.method = CandidateMethod::kSubVoxel;
  TURNSCAN_ASSIGN(auto made, reconstruct_until(stage, frames, options, context));
  if (auto* cloud = std::get_if<PointCloud>(&made))
    return cloud_run(std::move(*cloud), frames, model, stage, options.merge.speed_rad_s, note,
                     context);
  auto& result = std::get<Reconstruction>(made);
  if (stage != kMeshStage)
    return fail(ErrorCode::kUnsupported,
                "the stage {} is not a part of this method; choose another method", stage);
  if (!note.empty()) result.notes.insert(result.notes.begin(), note);
  if (options.surface.repair) TURNSCAN_TRY(check_watertight(result));
  return mesh_run(std::move(result), model, context);
}

ModelDataPtr with_note(const ModelData& data, const QString& note) {
  auto told = std::make_shared<ModelData>(data);
  told->report += note;
  return told;
}

Result<StageRun> run_recording(const Model& model, const std::string& stage,
                               const ReconstructOptions& options, const RunContext& context) {
  const FrameSequence& recording = *model.data->recording;
  StageRun run;
  if (stage == kMeshStage) {
    TURNSCAN_ASSIGN(run, mesh_of_recording(model, options, {}, context));
  } else {
    TURNSCAN_ASSIGN(CalibratedFrames calibrated,
                    calibrate_frames(recording, "auto", false, options, context));
    TURNSCAN_ASSIGN(run, run_on(*calibrated.frames, model, stage, std::move(calibrated.options),
                                calibrated.choice.note, context));
  }
  // The recording's notes, e.g. on damaged frames that were left out, go with the result.
  if (model.data->recording_notes.empty()) return run;
  QString notes;
  for (const std::string& note : model.data->recording_notes)
    notes += QObject::tr("\nNote: %1").arg(QString::fromStdString(note));
  for (auto& [name, data] : run.models) data = with_note(*data, notes);
  return run;
}

/// With what made it.
Result<StageRun> as_made(Result<StageRun> run, const Model& input, const std::string& stage,
                         ReconstructOptions options) {
  if (!run) return run;
  auto made = std::make_shared<MadeWith>();
  made->input = input.data;
  made->stage = stage;
  ReconstructOptions defaults;
  const auto given = describe_stages(options), usual = describe_stages(defaults);
  for (std::size_t i = 0; i < given.size(); ++i)
    for (const OptionField& field : given[i].table.fields()) {
      const std::string value = field.get(), otherwise = usual[i].table.find(field.name)->get();
      if (value != otherwise) made->changed.push_back({field.name, value, otherwise});
    }
  const auto is_in = [](const std::vector<ResolvedParameter>& list, const auto& is_it) {
    return std::any_of(list.begin(), list.end(), is_it);
  };
  for (const ResolvedParameter& choice : run->choices) {
    const auto same = [&](const auto& other) { return other.option == choice.option; };
    const auto equal = [&](const auto& other) {
      return same(other) && other.value == choice.value;
    };
    // Each pass has a choice of its own, mostly the same.
    if (!is_in(made->changed, same) && !is_in(made->chosen, equal)) made->chosen.push_back(choice);
  }
  run->made = std::move(made);
  return run;
}

Result<StageRun> run_cloud(const Model& model, const std::string& stage, ReconstructOptions options,
                           const RunContext& context) {
  std::string note = fmt::format("made from the {} points of '{}', not from frames of a recording",
                                 model.data->cloud.size(), model.name.toStdString());
  if (options.surface.method == SurfaceMethod::kVolumetric) {
    options.surface.method = SurfaceMethod::kPoisson;
    note += "; method volumetric needs frames, a cloud takes poisson";
  }
  options.crop.enabled = false;
  options.outliers.enabled = options.merge.cloud_outliers;
  options.base.enabled = false;
  options.texture.texture = false;  // there are no images
  const auto frames = sequence_of(model.data->cloud, model.data->viewpoints);
  return run_on(*frames, model, stage, std::move(options), note, context);
}

}  // namespace

Result<StageRun> run_stage_of(const Model& model, const std::string& stage,
                              const ReconstructOptions& options, const RunContext& context) {
  switch (model.data->kind) {
    case ModelKind::kRecording:
      return as_made(run_recording(model, stage, options, context), model, stage, options);
    case ModelKind::kCloud:
      return as_made(run_cloud(model, stage, options, context), model, stage, options);
    case ModelKind::kMesh:
      break;
  }
  return fail(ErrorCode::kUnsupported, "'{}' is a mesh already; select a recording or a cloud",
              model.name.toStdString());
}

PhasePlan stage_phases(const Model& model, const std::string& stage,
                       const ReconstructOptions& options) {
  if (model.data->kind != ModelKind::kRecording || stage != kMeshStage) return {};
  ReconstructRequest request;
  request.options = options;
  return joined({reconstruct_phases({{"", model.data->recording.get()}}, request),
                 {{"prepare the view", 1.0}}});
}

Result<StageRun> join_stated(const Model& recording, const std::vector<PassPose>& poses,
                             const ReconstructOptions& options, const RunContext& context) {
  TURNSCAN_ASSIGN(StageRun run, mesh_of_recording(recording, options, poses, context));
  QString same;
  for (const PassPose& pose : poses)
    same += QString(" --pass-pose %1").arg(QString::fromStdString(pass_pose_text(pose)));
  const QString note =
      QObject::tr("\nThe command line makes it with%1 --refine-pass-poses").arg(same);
  for (auto& [name, data] : run.models) data = with_note(*data, note);
  return as_made(std::move(run), recording, kMeshStage, options);
}

Result<StageRun> mesh_each_pass(const Model& recording, const ReconstructOptions& options,
                                const RunContext& context) {
  StageRun out;
  QStringList reasons;
  for (const std::uint32_t pass : passes_of(*recording.data->recording)) {
    ReconstructOptions of_one = options;
    of_one.merge.pass = int(pass);
    auto run = mesh_of_recording(recording, of_one, {}, context);
    if (!run && run.error().code == ErrorCode::kCancelled)
      return tl::unexpected<Error>(std::move(run).error());
    if (!run) {
      reasons
          << QObject::tr("pass %1: %2").arg(pass).arg(QString::fromStdString(run.error().text()));
      continue;
    }
    for (auto& [name, data] : run->models)
      out.models.emplace_back(QObject::tr("%1 of pass %2").arg(name).arg(pass), std::move(data));
  }
  out.not_joined = reasons.join("\n");
  if (out.models.empty()) return fail(ErrorCode::kTooFewPoints, "{}", out.not_joined.toStdString());
  return as_made(std::move(out), recording, kMeshStage, options);
}

Result<ModelDataPtr> filter_cloud(const Model& model, const OutlierOptions& options,
                                  const RunContext& context) {
  if (model.data->kind != ModelKind::kCloud)
    return fail(ErrorCode::kUnsupported,
                "'{}' is not a cloud; the frames of a recording are filtered when it is merged",
                model.name.toStdString());
  const PointCloud& from = model.data->cloud;
  context.begin_phase("filter", 0);
  TURNSCAN_ASSIGN(const auto inlier,
                  outliers::statistical_outlier_mask(from.points, options, context));
  PointCloud inliers = points_where(from, [&](std::size_t i) { return inlier[i] != 0; });
  context.begin_phase("prepare the view", 0);
  const QString report = QObject::tr("%1 of %2 points were dropped")
                             .arg(grouped(from.size() - inliers.size()), grouped(from.size()));
  return cloud_model(std::move(inliers), QObject::tr("filter of %1").arg(model.name), report,
                     model.data->viewpoints);
}

}  // namespace turnscan::studio
