#pragma once
// What views measured around the vertices of a mesh.

#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>
#include <turnscan/reconstruction/mesh_refinement/vertex_kernel.hpp>

namespace turnscan::mesh_refinement {

/// Sums over views, by vertex, as VertexSums has them.
struct VertexObservations {
  VertexMeasurements measured;
  std::vector<float> near;
};

/// Projects vertices into views and sums what is measured there, on all cores. Vertices that face
/// alike are done together, so that views which see none of them are left out.
class VertexObserver {
 public:
  explicit VertexObserver(const TriangleMesh& mesh);

  /// Calls of context.advance() by observe().
  std::size_t blocks() const;

  /// Where they are now. spread: squared, as VertexColumns::spread; empty: 1.
  void set_vertices(const std::vector<Vec3f>& positions, const std::vector<Vec3f>& normals,
                    const std::vector<float>& spread);

  /// Over every stride-th view. Fails with kCancelled.
  Result<VertexObservations> observe(std::span<const views::DepthView> views, std::size_t stride,
                                     const MeshFitScale& scale, const RunContext& context) const;

 private:
  /// A ball around the vertices of a block, and a cone around their normals, for culling.
  struct Patch {
    Vec3f center = Vec3f::Zero(), axis = Vec3f::Zero();
    float radius = 0.0f, opening = 0.0f;  // metres, radians
  };
  Patch patch(std::size_t begin, std::size_t end) const;
  static bool turned_away(const views::DepthView& view, const Patch& patch);
  static bool outside_window(const views::DepthView& view, const Patch& patch);

  std::vector<std::uint32_t> order_;  ///< place in the columns: vertex
  std::array<std::vector<float>, 7> columns_;
};

}  // namespace turnscan::mesh_refinement
