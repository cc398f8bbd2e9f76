#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

Box bounds(const std::vector<Vec3f>& points) {
  Box box;
  for (const Vec3f& p : points) box.add(p.cast<double>());
  return box;
}

Result<> validate_mesh(const TriangleMesh& mesh, std::string_view what) {
  const std::size_t n = mesh.vertices.size();
  if ((!mesh.normals.empty() && mesh.normals.size() != n) ||
      (!mesh.colors.empty() && mesh.colors.size() != n)) {
    return fail(ErrorCode::kFormat,
                "{}: {} vertices, but {} normals and {} colours; give one for each vertex or none",
                what, n, mesh.normals.size(), mesh.colors.size());
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (const std::uint32_t v : mesh.triangles[t]) {
      if (v >= n) {
        return fail(ErrorCode::kFormat,
                    "{}: triangle {} names vertex {}, but there are only {}; repair the mesh", what,
                    t, v, n);
      }
      if (!mesh.vertices[v].allFinite()) {
        return fail(ErrorCode::kFormat, "{}: vertex {} is not finite; repair the mesh", what, v);
      }
    }
  }
  return {};
}

}  // namespace turnscan
