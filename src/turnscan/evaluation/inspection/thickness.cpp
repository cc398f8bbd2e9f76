#include <turnscan/evaluation/inspection/thickness.hpp>

#include <cmath>
#include <limits>
#include <turnscan/core/parallel.hpp>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/geometry/mesh/mesh_repair.hpp>
#include <turnscan/geometry/rays/scene.hpp>

namespace turnscan {

namespace {

/// Where a ray from inside first leaves the mesh. Triangles that it enters by are those around its
/// origin, or overlap.
float leaves_at(const Scene& scene, Ray ray) {
  while (true) {
    const RayHit hit = scene.intersect(ray);
    if (!hit.valid()) return std::numeric_limits<float>::quiet_NaN();
    if (hit.normal.dot(ray.direction) > 0.0f) return hit.t;
    ray.t_min = std::nextafter(std::max(hit.t, ray.t_min), std::numeric_limits<float>::infinity());
  }
}

}  // namespace

Result<std::vector<float>> wall_thicknesses(const TriangleMesh& mesh, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  if (mesh.empty())
    return fail(ErrorCode::kTooFewPoints, "thickness: the mesh has no triangles; check it");
  context.begin_phase("thickness", 0);
  TURNSCAN_ASSIGN(const Scene scene, Scene::create(std::span(&mesh, 1), std::nullopt, context));
  const std::vector<Vec3f> normals = vertex_normals(mesh);
  std::vector<float> out(mesh.vertices.size(), std::numeric_limits<float>::quiet_NaN());
  parallel_for(out.size(), 1024, [&](std::size_t v) {
    if (context.cancelled() || !mesh.vertices[v].allFinite() || normals[v].isZero()) return;
    Ray ray;
    ray.origin = mesh.vertices[v];
    ray.direction = -normals[v];
    out[v] = leaves_at(scene, ray);
  });
  TURNSCAN_TRY(context.check());
  return out;
}

TriangleMesh color_by_thickness(TriangleMesh mesh, const std::vector<float>& thickness_m,
                                double thickest_m) {
  constexpr Rgb kUnknown{128, 128, 128};
  mesh.colors.assign(mesh.vertices.size(), kUnknown);
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    if (std::isfinite(thickness_m[v]))
      mesh.colors[v] = viridis(1.0 - double(thickness_m[v]) / thickest_m);
  return mesh;
}

}  // namespace turnscan
