#include <cmath>
#include <turnscan/core/parallel.hpp>
#include <turnscan/evaluation/colormap.hpp>
#include <turnscan/evaluation/evaluate.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan {

Result<TriangleMesh> color_by_error(const TriangleMesh& mesh, const TriangleMesh& reference,
                                    double max_error_m, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh, "mesh"));
  TURNSCAN_TRY(validate_mesh(reference, "reference"));
  if (!(max_error_m > 0.0) || !std::isfinite(max_error_m)) {
    return fail(ErrorCode::kInvalidOption,
                "error map: a largest error of {} m; give a positive one", max_error_m);
  }
  if (reference.empty()) {
    return fail(ErrorCode::kTooFewPoints, "error map: the reference has no triangles; check it");
  }
  TURNSCAN_ASSIGN(const MeshDistance distance, MeshDistance::create(reference, context));
  TriangleMesh colored = mesh;
  colored.colors.assign(mesh.vertices.size(), Rgb());
  TURNSCAN_TRY(parallel_for(mesh.vertices.size(), 1024, context, [&](std::size_t v) {
    if (!mesh.vertices[v].allFinite()) return;
    const auto hit = distance.closest(mesh.vertices[v].cast<double>());
    colored.colors[v] = viridis(hit.distance / max_error_m);
  }));
  return colored;
}

}  // namespace turnscan
