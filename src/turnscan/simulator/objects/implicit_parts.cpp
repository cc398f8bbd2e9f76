#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/objects/implicit_parts.hpp>

namespace turnscan::objects {

namespace {

/// Of a neighbourhood as large as a triangle: softens the steps along borders between colours.
Rgb mean_color(const Vec3f& p, ShapeAt shape_at) {
  Eigen::Vector3i sum(2, 2, 2);
  for (const Vec3f& k : {Vec3f(1, -1, -1), Vec3f(-1, -1, 1), Vec3f(-1, 1, -1), Vec3f(1, 1, 1)}) {
    const Rgb c = shape_at(p + 0.4f * k).color;
    sum += Eigen::Vector3i(c.r, c.g, c.b);
  }
  return {std::uint8_t(sum.x() / 4), std::uint8_t(sum.y() / 4), std::uint8_t(sum.z() / 4)};
}

}  // namespace

Result<TriangleMesh> mesh_of_shape(const std::string& name, ShapeAt shape_at,
                                   const ImplicitGrid& grid, const RunContext& context) {
  const auto distance = [shape_at](const Vec3f& p) { return 1e-3f * shape_at(1000.0f * p).d; };
  TURNSCAN_ASSIGN(TriangleMesh mesh, mesh_of(distance, grid, context));
  mesh.name = name;
  mesh.colors.resize(mesh.vertices.size());
  TURNSCAN_TRY(parallel_for(mesh.vertices.size(), 256, context, [&](std::size_t i) {
    mesh.colors[i] = mean_color(1000.0f * mesh.vertices[i], shape_at);
  }));
  return mesh;
}

}  // namespace turnscan::objects
