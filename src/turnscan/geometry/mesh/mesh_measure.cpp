#include <turnscan/geometry/mesh/mesh_measure.hpp>

namespace turnscan {

double triangle_area(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3d u = (mesh.vertices[b] - mesh.vertices[a]).cast<double>();
  const Vec3d v = (mesh.vertices[c] - mesh.vertices[a]).cast<double>();
  return 0.5 * u.cross(v).norm();
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += triangle_area(mesh, t);
  return area;
}

double signed_volume(const TriangleMesh& mesh) {
  double six = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3d p = mesh.vertices[a].cast<double>(), q = mesh.vertices[b].cast<double>(),
                r = mesh.vertices[c].cast<double>();
    six += p.dot(q.cross(r));
  }
  return six / 6.0;
}

}  // namespace turnscan
