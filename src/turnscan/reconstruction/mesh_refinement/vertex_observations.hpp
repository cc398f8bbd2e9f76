#pragma once
// Measurements of views around the vertices of a mesh.

#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>
#include <turnscan/reconstruction/mesh_refinement/vertex_kernel.hpp>

namespace turnscan::mesh_refinement {

/// Projects vertices into views and sums the measurements there, on all cores. Vertices with
/// similar normals are processed together, so that views which see none of them are skipped.
class VertexObserver {
 public:
  explicit VertexObserver(const TriangleMesh& mesh);

  /// Number of calls of context.advance() by observe().
  std::size_t blocks() const;

  /// Sets the current positions.
  void set_vertices(const std::vector<Vec3f>& positions, const std::vector<Vec3f>& normals);

  /// Sums over the chosen views. Fails with kCancelled.
  Result<VertexMeasurements> observe(std::span<const views::DepthView> views,
                                     std::span<const std::size_t> chosen, const MeshFitScale& scale,
                                     const RunContext& context) const;

 private:
  /// Bounding ball of the vertices of a block, and cone around their normals, for culling.
  struct Patch {
    Vec3f center = Vec3f::Zero(), axis = Vec3f::Zero();
    float radius = 0.0f, opening = 0.0f;  // metres, radians
  };
  Patch patch(std::size_t begin, std::size_t end) const;
  static bool turned_away(const views::DepthView& view, const Patch& patch);
  static bool outside_window(const views::DepthView& view, const Patch& patch);

  std::vector<std::uint32_t> order_;  ///< vertex of each index in the columns
  std::array<std::vector<float>, 6> columns_;
  std::vector<Patch> patches_;  ///< of each block
};

}  // namespace turnscan::mesh_refinement
