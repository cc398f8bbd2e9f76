#pragma once
// Where each triangle of a mesh lies in a square picture.

#include <Eigen/Core>
#include <array>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::texture {

/// Charts are placed on squares of this many texels: no square is shared by two charts.
inline constexpr int kBlock_px = 8;
/// Texels between a chart and the border of its squares, at least; between two charts twice that.
inline constexpr int kPadding_px = 2;

/// Corners are in texels from the upper left corner of the picture, y down; the centre of the first
/// texel is (0.5, 0.5). They are multiples of 1/256, and no two triangles cover the same texel's
/// centre.
struct Atlas {
  int size_px = 0;
  std::vector<std::array<Eigen::Vector2f, 3>> corners;  ///< per triangle
  std::vector<std::uint32_t> chart;                     ///< per triangle
  std::size_t charts = 0;
  double texels_per_m = 0.0;  ///< along the surface, where it is seen straight on
  double stretch = 1.0;       ///< greatest of a triangle: largest over smallest scale
};

/// Charts are drawn along their mean normals, split where they would cover themselves, and packed
/// as large as they fit (Levy et al. 2002, "Least squares conformal maps", section 4: by their
/// outlines). texels_per_m: no larger than that. size_px: a multiple of kBlock_px. Fails with
/// kResourceLimit when the mesh has more charts than fit, with kCancelled. The same for any number
/// of threads.
Result<Atlas> make_atlas(const TriangleMesh& mesh, int size_px, double texels_per_m,
                         const RunContext& context);

/// Side of a square picture that shows the mesh at that scale, as far as can be told beforehand.
double expected_side_px(const TriangleMesh& mesh, double texels_per_m);

/// Calls texel(column, row) for each texel whose centre a triangle of the picture covers. Centres
/// on an edge belong to one of the triangles beside it.
template <class Texel>
void for_each_texel(const std::array<Eigen::Vector2f, 3>& corners, const Texel& texel);

}  // namespace turnscan::texture

#include <turnscan/reconstruction/texture/texel_raster.inl>
