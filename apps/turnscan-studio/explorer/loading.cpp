#include "explorer/loading.hpp"

#include <filesystem>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/file/existence.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/workflow/input.hpp>
#include <turnscan/workflow/output_file.hpp>
#include <turnscan/workflow/text/mesh_text.hpp>

#include "explorer/output/export_model.hpp"
#include "widgets/text.hpp"

namespace turnscan::studio {

namespace fs = std::filesystem;

namespace {

QString text_of(const Box& box) {
  return box.empty() ? QObject::tr("empty") : QString::fromStdString(size_text(box));
}

QString mesh_report(const TriangleMesh& mesh) {
  const MeshReport report = check_surface(mesh);
  QString text = QObject::tr("%1 vertices, %2 triangles in %3\n%4\nArea %5 cm²")
                     .arg(grouped(report.vertices), grouped(report.triangles))
                     .arg(report.components == 1 ? QObject::tr("1 piece")
                                                 : QObject::tr("%1 pieces").arg(report.components))
                     .arg(text_of(bounds(mesh.vertices)))
                     .arg(report.area_m2 * 1e4, 0, 'f', 2);
  if (has_texture(mesh))
    text += QObject::tr("\nTexture of %1 × %2 texels")
                .arg(mesh.texture->image.width)
                .arg(mesh.texture->image.height);
  if (report.closed) text += QObject::tr(", volume %1 cm³").arg(report.volume_m3 * 1e6, 0, 'f', 2);
  return text + "\n" + QString::fromStdString(check_sentences(report));
}

QString cloud_report(const PointCloud& cloud) {
  QString text = QObject::tr("%1 points%2%3\n%4")
                     .arg(grouped(cloud.size()),
                          cloud.normals.empty() ? QString() : QObject::tr(", with normals"),
                          cloud.colors.empty() ? QString() : QObject::tr(", with colours"),
                          text_of(bounds(cloud.points)));
  return text;
}

/// Preview of a recording before it is merged: the first complete frame, at its pose on the table,
/// or upright as seen by the camera.
Result<PointCloud> preview(const FrameSequence& recording, const RunContext& context) {
  PointCloud out;
  const auto& frames = recording.frames();
  for (std::size_t i = 0; i < frames.size() && out.empty(); ++i) {
    TURNSCAN_TRY(context.check());
    if (frames[i].status == FrameStatus::kDropped) continue;
    const SensorInfo& sensor = recording.header().sensors[frames[i].sensor];
    auto frame = recording.read(i);
    if (!frame) continue;  // the summary reports it
    auto points = points_of(*frame, sensor, RayTable(sensor.intrinsics));
    if (!points) continue;
    const Pose upright(Eigen::AngleAxisd(EIGEN_PI, Vec3d::UnitX()));
    const Pose pose = sensor.T_table_sensor.value_or(upright);
    out.colors = points->cloud.colors;
    for (const Vec3f& p : points->cloud.points)
      out.points.push_back((pose * p.cast<double>()).cast<float>());
  }
  return out;
}

}  // namespace

ModelDataPtr mesh_model(TriangleMesh mesh, const QString& source, const QString& report,
                        std::vector<float> confidence) {
  auto data = std::make_shared<ModelData>();
  data->confidence = std::move(confidence);
  data->kind = ModelKind::kMesh;
  data->source = source;
  data->report = mesh_report(mesh) + (report.isEmpty() ? "" : "\n\n" + report);
  data->drawable = make_drawable(mesh);
  data->mesh = std::move(mesh);
  return data;
}

ModelDataPtr cloud_model(PointCloud cloud, const QString& source, const QString& report,
                         std::vector<Viewpoint> viewpoints) {
  auto data = std::make_shared<ModelData>();
  data->kind = ModelKind::kCloud;
  data->source = source;
  data->report = cloud_report(cloud) + (report.isEmpty() ? "" : "\n\n" + report);
  data->drawable = make_drawable(cloud);
  data->cloud = std::move(cloud);
  data->viewpoints = std::move(viewpoints);
  return data;
}

Result<ModelDataPtr> recording_model(const std::string& path, const RunContext& context) {
  TURNSCAN_ASSIGN(Input input, open_input(path, ImportOptions(), context));
  TURNSCAN_ASSIGN(const SequenceSummary summary, summarize(input, context));
  auto data = std::make_shared<ModelData>();
  data->kind = ModelKind::kRecording;
  data->source = QString::fromStdString(path);
  data->report = QString::fromStdString(summary_text(summary));
  TURNSCAN_ASSIGN(data->cloud, preview(*input.frames, context));
  data->drawable = make_drawable(data->cloud);
  data->recording = std::move(input.frames);
  data->recording_notes = std::move(input.notes);
  return ModelDataPtr(std::move(data));
}

namespace {

/// Notes the unit with which a file was read, if it was specified.
ModelDataPtr told_unit(const ModelDataPtr& data, std::optional<double> metres_per_unit) {
  if (!metres_per_unit) return data;
  auto told = std::make_shared<ModelData>(*data);
  told->metres_per_unit = metres_per_unit;
  return told;
}

void scale_cloud(PointCloud& cloud, double factor) {
  for (Vec3f& p : cloud.points) p *= float(factor);
}

}  // namespace

Result<NamedModels> load_models(const std::string& path, const RunContext& context,
                                std::optional<double> metres_per_unit) {
  const fs::path file(path);
  TURNSCAN_TRY(file::check_exists(file, "file or folder"));
  std::error_code error;
  const QString name = QString::fromStdString(file.stem().string());
  const bool folder = fs::is_directory(file, error);
  if (folder || file.filename() == "recording.json") {
    const fs::path base = folder ? file : file.parent_path();
    TURNSCAN_ASSIGN(ModelDataPtr data,
                    recording_model(base.empty() ? "." : base.string(), context));
    const QString title = QString::fromStdString(fs::absolute(base).filename().string());
    return NamedModels{{title.isEmpty() ? name : title, std::move(data)}};
  }
  if (is_foreign(file)) {
    TURNSCAN_ASSIGN(ModelDataPtr data, recording_model(path, context));
    return NamedModels{{name, std::move(data)}};
  }
  const QString source = QString::fromStdString(path);
  context.begin_phase("read", 0);
  const std::string ending = ending_of(path);
  const auto as_cloud = [&]() -> Result<NamedModels> {
    TURNSCAN_ASSIGN(CloudFile cloud, read_cloud(file));
    TURNSCAN_TRY(context.check());
    context.begin_phase("prepare the view", 0);
    if (metres_per_unit) scale_cloud(cloud.cloud, *metres_per_unit);
    return NamedModels{
        {name, told_unit(cloud_model(std::move(cloud.cloud), source), metres_per_unit)}};
  };
  if (ending == ".pcd") return as_cloud();
  auto meshes = read_meshes(file, {metres_per_unit}, context);
  if (!meshes && meshes.error().code == ErrorCode::kTooFewPoints && ending == ".ply")
    return as_cloud();
  if (!meshes) return tl::unexpected<Error>(meshes.error());
  context.begin_phase("check", meshes->size());
  NamedModels out;
  for (TriangleMesh& mesh : *meshes) {
    TURNSCAN_TRY(context.check());
    const bool named = !mesh.name.empty() && meshes->size() > 1;
    const QString title = named ? QString::fromStdString(mesh.name) : name;
    out.emplace_back(title, told_unit(mesh_model(std::move(mesh), source), metres_per_unit));
    context.advance();
  }
  return out;
}

Result<> save_model(const ModelData& data, const std::string& path) {
  switch (data.kind) {
    case ModelKind::kMesh:
      if (has_texture(data.mesh) && !holds_textures(path))
        return write_mesh(path, with_vertex_colors(data.mesh), data.confidence);
      return write_mesh(path, data.mesh, data.confidence);
    case ModelKind::kCloud:
      return write_cloud(path, data.cloud);
    case ModelKind::kRecording:
      break;
  }
  return fail(ErrorCode::kUnsupported,
              "a recording is a folder already; copy it, or save what is made from it");
}

}  // namespace turnscan::studio
