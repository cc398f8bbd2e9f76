#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/geometry/grid/wrap.hpp>
#include <turnscan/geometry/grid/wrap_steps.hpp>
#include <turnscan/geometry/mesh/mesh_check.hpp>
#include <turnscan/geometry/search/closest_point.hpp>

namespace turnscan {
namespace {

constexpr double kAutoCells = 200.0;

/// Colour of the soup at a point of one of its triangles.
Rgb color_at(const TriangleMesh& soup, std::uint32_t triangle, const Vec3d& p) {
  const auto& corners = soup.triangles[triangle];
  Vec3d weights;
  for (int c = 0; c < 3; ++c) {
    const Vec3d b = soup.vertices[corners[std::size_t(c + 1) % 3]].cast<double>();
    const Vec3d d = soup.vertices[corners[std::size_t(c + 2) % 3]].cast<double>();
    weights[c] = (b - p).cross(d - p).norm();
  }
  if (!(weights.sum() > 0.0)) return soup.colors[corners[0]];
  Vec3d sum = Vec3d::Constant(0.5);
  for (int c = 0; c < 3; ++c) {
    const Rgb& color = soup.colors[corners[std::size_t(c)]];
    sum += weights[c] / weights.sum() * Vec3d(color.r, color.g, color.b);
  }
  const Vec3d rounded = sum.cwiseMin(255.0);
  return {std::uint8_t(rounded.x()), std::uint8_t(rounded.y()), std::uint8_t(rounded.z())};
}

grid::WrapMeasures measures_for(const Box& box, const WrapOptions& options) {
  const double cell = options.cell_m.value_or(box.size().maxCoeff() / kAutoCells);
  return {cell, options.offset_cells * cell, (options.offset_cells + grid::kWrapBandCells) * cell};
}

Box bounds_of_triangles(const TriangleMesh& mesh) {
  Box box;
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) box.add(mesh.vertices[v].cast<double>());
  }
  return box;
}

}  // namespace

OptionTable describe(WrapOptions& options) {
  OptionTable table;
  table.number("wrap-cell", options.cell_m, Quantity::kLength, {1e-6, 1e3},
               "Cell size of the grid on which a surface is wrapped; auto: 1/200 of its longest "
               "side.");
  table.number("wrap-offset", options.offset_cells, Quantity::kNone, {0.9, 8.0},
               "How far around the surface the wrap is laid before it is pulled back, in cells; "
               "gaps of up to twice as much are closed.");
  table.flag("wrap-project", options.project, "Pull the wrap back onto the surface.");
  return table;
}

Result<TriangleMesh> wrap(const TriangleMesh& mesh, const WrapOptions& options,
                          const RunContext& context) {
  TURNSCAN_TRY(validate_mesh(mesh));
  WrapOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  const Box box = bounds_of_triangles(mesh);
  const grid::WrapMeasures measures = measures_for(box, options);
  if (mesh.empty() || !(measures.cell_m > 0.0)) {
    return fail(ErrorCode::kTooFewPoints, "wrap: the mesh has no extent; check the mesh");
  }
  const MeshDistance soup(mesh);
  TURNSCAN_ASSIGN(const BrickGrid field,
                  grid::wrap_field(soup, box, measures, options.max_bytes, context));
  TURNSCAN_ASSIGN(TriangleMesh wrapped, isosurface(field, IsosurfaceOptions(), context));
  wrapped.name = mesh.name;
  if (options.project) TURNSCAN_TRY(grid::pull_onto(soup, measures, wrapped, context));
  if (!mesh.colors.empty()) {
    wrapped.colors.resize(wrapped.vertices.size());
    parallel_for(wrapped.vertices.size(), 1024, [&](std::size_t v) {
      const auto hit = soup.closest(wrapped.vertices[v].cast<double>());
      wrapped.colors[v] = color_at(mesh, hit.triangle, hit.point);
    });
  }
  return wrapped;
}

}  // namespace turnscan
