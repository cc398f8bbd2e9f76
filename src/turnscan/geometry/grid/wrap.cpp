#include <turnscan/geometry/grid/wrap.hpp>
#include <turnscan/geometry/grid/wrap_steps.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan::grid {

Result<TriangleMesh> wrap(const TriangleMesh& mesh, double cell_m, const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  if (mesh.empty())
    return fail(ErrorCode::kTooFewPoints, "wrap: the mesh has no triangle; check the mesh");
  if (!(cell_m > 0.0))
    return fail(ErrorCode::kInvalidOption, "wrap: cells of {} m; give more than 0", cell_m);
  TURNSCAN_ASSIGN(const MeshDistance soup, MeshDistance::create(mesh, context));
  TURNSCAN_ASSIGN(const BrickGrid field, wrap_field(soup, mesh, cell_m, context));
  TURNSCAN_ASSIGN(TriangleMesh wrapped, isosurface(field, MarchingCells::kTetrahedra, context));
  wrapped.name = mesh.name;
  TURNSCAN_TRY(pull_onto(soup, cell_m, wrapped, context));
  return wrapped;
}

}  // namespace turnscan::grid
