#pragma once
// The parts of fit_mesh(): vertex adjacency, offsets of the vertices, steps, and fairing of
// unmeasured vertices.

#include <cstdint>
#include <span>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit.hpp>

namespace turnscan::mesh_refinement {

/// Vertices joined by an edge, in a closed mesh.
struct MeshNeighbours {
  std::vector<std::uint32_t> begin, list;

  explicit MeshNeighbours(const TriangleMesh& mesh);
  float count(std::size_t v) const { return float(begin[v + 1] - begin[v]); }
  /// The mean over the neighbours; the vertex's own value if it has none.
  template <class T>
  T mean(const std::vector<T>& values, std::size_t v, const T& zero) const {
    T sum = zero;
    each(v, [&](std::uint32_t other) { sum += values[other]; });
    return begin[v + 1] > begin[v] ? T(sum / count(v)) : values[v];
  }
  template <class Visit>
  void each(std::size_t v, const Visit& visit) const {
    for (std::uint32_t k = begin[v]; k < begin[v + 1]; ++k) visit(list[k]);
  }
  /// The smallest and the largest value over each vertex and the given number of rings around it.
  std::vector<float> least(std::vector<float> values, int rings) const;
  std::vector<float> largest(std::vector<float> values, int rings) const;
};

/// Sums of the measurements around each vertex.
struct VertexMeasurements {
  std::vector<float> support;  ///< sum of the weights
  std::vector<float> offset;   ///< sum of weight times distance along the normal
};

/// Whether a vertex is below the given share of the floor's height, where only the platter is
/// measured.
inline bool below_floor(const Vec3f& vertex, const MeshFitScale& scale, float share = 1.0f) {
  return scale.floor_height_m && vertex.y() < share * float(*scale.floor_height_m) &&
         !(scale.measured_below && scale.measured_below(vertex));
}

/// Independent samples of the measurements' errors, from which the fit chooses its stiffness.
inline constexpr std::size_t kErrorSamples = 3;
struct FittedOffsets {
  std::vector<float> offset;               ///< of each vertex along its normal
  std::vector<std::vector<float>> errors;  ///< what the same fit makes of each sample of errors
};

/// errors: kErrorSamples samples of the errors of VertexMeasurements::offset, or none: then the
/// surface has the stiffness of the scale everywhere. known: sum over the samples of their variance
/// over that of the errors.
FittedOffsets fitted_offsets(const TriangleMesh& mesh, const MeshNeighbours& neighbours,
                             const std::vector<Vec3f>& normals, const VertexMeasurements& measured,
                             const MeshFitScale& scale, std::span<const std::vector<float>> errors,
                             const std::vector<float>& known);

/// Smallest cosine between a triangle's normals before and after take_steps().
inline constexpr float kMinTurn = 0.3f;
/// Adds the steps to the vertices, shortened or omitted where a triangle would rotate by more.
void take_steps(TriangleMesh& mesh, std::vector<Vec3f> step);

/// Where little or nothing was measured, the volume's surface is ragged, pixel by pixel. Moves
/// those vertices towards the mean of their neighbours, constrained by what was measured around
/// them.
void fair(TriangleMesh& mesh, const MeshNeighbours& neighbours, const std::vector<float>& support,
          const MeshFitScale& scale);

/// Below the floor nothing was measured: walls continue straight down from what was fitted above
/// them, smooth along the base's outline, and the base's vertices follow.
void straighten_walls(TriangleMesh& mesh, const MeshNeighbours& neighbours,
                      const std::vector<float>& support, const MeshFitScale& scale);

}  // namespace turnscan::mesh_refinement
