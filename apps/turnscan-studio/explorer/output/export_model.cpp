#include "explorer/output/export_model.hpp"

#include <algorithm>
#include <turnscan/core/mesh_texture.hpp>
#include <turnscan/geometry/mesh/simplify.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/workflow/output_file.hpp>

namespace turnscan::studio {

namespace {

/// The writers convert metres to unit_of_format(ending).
float factor_for(const ExportOptions& options, const std::string& ending) {
  return units_are_free(ending) ? float(unit_of_format(ending) / options.metres_per_unit) : 1.0f;
}

}  // namespace

TriangleMesh with_vertex_colors(const TriangleMesh& mesh) {
  TriangleMesh out = mesh;
  out.texture.reset();
  std::vector<Vec3f> sum(mesh.vertices.size(), Vec3f::Zero());
  std::vector<float> count(mesh.vertices.size(), 0.0f);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.triangles[t][k];
      sum[v] += texture_at(mesh.texture->image, mesh.texture->corners[t][k]);
      count[v] += 1.0f;
    }
  const auto byte = [](float value) {
    return static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
  };
  out.colors.assign(mesh.vertices.size(), Rgb{128, 128, 128});
  for (std::size_t v = 0; v < sum.size(); ++v) {
    if (count[v] == 0.0f) continue;
    const Vec3f color = sum[v] / count[v];
    out.colors[v] = {byte(color.x()), byte(color.y()), byte(color.z())};
  }
  return out;
}

bool units_are_free(const std::string& ending) {
  return ending == ".ply" || ending == ".obj" || ending == ".stl";
}

double unit_of_format(const std::string& ending) {
  return ending == ".stl" || ending == ".3mf" ? 1e-3 : 1.0;
}

Result<> export_model(const ModelData& data, const ExportOptions& options, const std::string& path,
                      const RunContext& context) {
  const std::string ending = ending_of(path);
  if (data.kind == ModelKind::kCloud) {
    PointCloud cloud = data.cloud;
    if (options.colors == ExportColors::kNone) cloud.colors.clear();
    for (Vec3f& p : cloud.points) p *= factor_for(options, ending);
    return write_cloud(path, cloud, options.up);
  }
  if (data.kind == ModelKind::kRecording)
    return fail(ErrorCode::kUnsupported,
                "a recording is a folder already; export what is made from it");
  TriangleMesh mesh = data.mesh;
  const bool fewer = options.triangles > 0 && options.triangles < mesh.triangles.size();
  const bool textured = has_texture(mesh) && options.colors == ExportColors::kTexture && !fewer &&
                        holds_textures(path);
  if (options.colors == ExportColors::kNone) {
    mesh.colors.clear();
    mesh.texture.reset();
  } else if (has_texture(mesh) && !textured) {
    mesh = with_vertex_colors(mesh);
  }
  if (fewer) {
    context.begin_phase("reduce", 0);
    TURNSCAN_ASSIGN(mesh, simplify(mesh, {.triangles = options.triangles}));
  }
  TURNSCAN_TRY(context.check());
  context.begin_phase("write", 0);
  const float factor = factor_for(options, ending);
  for (Vec3f& p : mesh.vertices) p *= factor;
  const WriteMeshOptions how{options.up};
  return fewer ? write_mesh(path, mesh, how) : write_mesh(path, mesh, data.confidence, how);
}

}  // namespace turnscan::studio
