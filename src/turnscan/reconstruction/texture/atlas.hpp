#pragma once
// Texture atlas: the layout of a mesh's triangles in a square image.

#include <array>
#include <turnscan/core/eigen.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::texture {

/// Charts are placed on squares of this many texels: no square is shared by two charts.
inline constexpr int kBlock_px = 8;
/// Minimum distance in texels of a chart from the border of its squares; between two charts twice
/// that.
inline constexpr int kPadding_px = 2;

/// Corners are in texels from the upper left corner of the image, y down; the centre of the first
/// texel is (0.5, 0.5). They are multiples of 1/256, and no two triangles cover the same texel's
/// centre.
struct Atlas {
  int size_px = 0;
  std::vector<std::array<Eigen::Vector2f, 3>> corners;  ///< per triangle
  std::vector<std::uint32_t> chart;                     ///< per triangle
  std::size_t charts = 0;
  double texels_per_m = 0.0;  ///< along the surface, where it faces the chart's direction
  double stretch = 1.0;       ///< maximum over the triangles: largest over smallest scale
};

/// Charts are projected along their mean normals, split where they would overlap themselves, and
/// packed at the largest scale at which they fit (Levy et al. 2002, "Least squares conformal maps",
/// section 4: by their outlines). texels_per_m: maximum scale. size_px: a multiple of kBlock_px.
/// Fails with kResourceLimit if the mesh has more charts than fit, with kCancelled. The result does
/// not depend on the number of threads.
Result<Atlas> make_atlas(const TriangleMesh& mesh, int size_px, double texels_per_m,
                         const RunContext& context);

/// Estimated side of a square image that shows the mesh at that scale.
double expected_side_px(const TriangleMesh& mesh, double texels_per_m);

/// Calls texel(column, row) for each texel whose centre is covered by a triangle with these
/// corners. Centres on an edge belong to one of the adjacent triangles.
template <class Texel>
void for_each_texel(const std::array<Eigen::Vector2f, 3>& corners, const Texel& texel);

}  // namespace turnscan::texture

#include <turnscan/reconstruction/texture/texel_raster.inl>
