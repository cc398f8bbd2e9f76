#pragma once
// The inner loop of the mesh refinement: sums one view's measurements around vertices of a mesh. A
// kernel (core/simd/kernel_choice.hpp).

#include <cstddef>
#include <cstdint>
#include <turnscan/core/lens.hpp>
#include <turnscan/core/simd/kernel_choice.hpp>

namespace turnscan::mesh_refinement {

/// A views::DepthView in the layout of the loops. Rows of rotation: x, y, z of the view.
struct VertexKernelView {
  const std::uint32_t* pixels;
  int width, height;
  float rotation[9], translation[3];
  float fx, fy, cx, cy;
  BrownConrady<float> lens;
  float unit, bias;
  int distorted;  ///< 1: Brown's model, 2: the rational model
  int parallel;
};

/// Vertices of a mesh, structure of arrays; all arrays, including those of the sums, are padded to
/// a multiple of kVertexRow.
inline constexpr std::size_t kVertexRow = 64;
struct VertexColumns {
  const float *x, *y, *z, *nx, *ny, *nz;
};
/// Sums over views: of weights, and of weight times distance along the vertex's normal.
struct VertexSums {
  float* weight;
  float* offset;
};
struct VertexKernelScale {
  float inverse_reach2;  ///< of the kernel across the normal
  float noise;           ///< of a depth along its ray
  float noise_floor;     ///< of a distance along the normal, added in quadrature
  float cut;             ///< Tukey's biweight ends at this many standard deviations
  float facing;          ///< smallest cosine between normal and ray
  float edge_weight;
};

struct VertexKernel {
  /// Adds for each of the vertices [begin, end), multiples of kVertexRow, the nearest measurement:
  /// its distance from the tangent plane along the normal.
  void (*add_view)(const VertexKernelView& view, const VertexColumns& vertices, std::size_t begin,
                   std::size_t end, const VertexKernelScale& scale, VertexSums& sums);
};
using VertexKernels = KernelChoice<VertexKernel>;

}  // namespace turnscan::mesh_refinement
