#include <turnscan/workflow/artefact_input.hpp>

#include <turnscan/io/cloud/cloud_io.hpp>
#include <turnscan/io/mesh/mesh_io.hpp>
#include <turnscan/workflow/output_file.hpp>

namespace turnscan {

namespace {

Result<PointCloud> cloud_of(const std::string& path, std::optional<double> metres_per_unit) {
  TURNSCAN_ASSIGN(CloudFile file, read_cloud(path));
  for (Vec3f& p : file.cloud.points) p *= static_cast<float>(metres_per_unit.value_or(1.0));
  return std::move(file.cloud);
}

}  // namespace

Result<PointCloud> read_artefact(const std::string& path, std::optional<double> metres_per_unit,
                                 const RunContext& context) {
  if (ending_of(path) == ".pcd") return cloud_of(path, metres_per_unit);
  const auto mesh = read_mesh(path, {metres_per_unit}, context);
  if (mesh) return artefact_points(*mesh, context);
  // A PLY file without triangles is a cloud.
  if (mesh.error().code == ErrorCode::kTooFewPoints && ending_of(path) == ".ply")
    return cloud_of(path, metres_per_unit);
  return tl::unexpected<Error>(mesh.error());
}

}  // namespace turnscan
