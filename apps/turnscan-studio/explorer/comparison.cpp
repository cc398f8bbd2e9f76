#include "explorer/comparison.hpp"

#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/geometry/search/closest_point.hpp>
#include <turnscan/geometry/search/sample.hpp>
#include <turnscan/workflow/text/evaluation_text.hpp>

#include "explorer/loading.hpp"

namespace turnscan::studio {

namespace {

constexpr std::size_t kBins = 48;
constexpr std::size_t kHistogramSamples = 60000;

/// Area-uniform samples of a mesh, or the points of a cloud, thinned.
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

Result<std::vector<float>> distances_of(const std::vector<Vec3f>& points,
                                        const MeshDistance& reference, const RunContext& context) {
  std::vector<float> out(points.size());
  TURNSCAN_TRY(parallel_for(points.size(), 1024, context, [&](std::size_t i) {
    out[i] = static_cast<float>(reference.closest(points[i].cast<double>()).distance);
  }));
  return out;
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
  TURNSCAN_ASSIGN(const std::vector<float> away, distances_of(cloud.points, distance, context));
  cloud.colors.clear();
  for (const float d : away) cloud.colors.push_back(viridis(d / scale_m));
  return cloud_model(std::move(cloud), source, report);
}

}  // namespace

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
      out.figures ? QString::fromStdString(evaluation_text(*out.figures)) : QString();
  context.begin_phase("distances", 0);
  TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(reference.mesh, context));
  TURNSCAN_ASSIGN(const auto points, probe(compared, context));
  TURNSCAN_ASSIGN(const std::vector<float> away, distances_of(points, distance, context));
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
