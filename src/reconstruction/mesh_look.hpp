#pragma once
// What views measured around the vertices of a mesh. Internal to the fit and to what follows it.

#include <turnscan/reconstruction/field_kernel.hpp>
#include <turnscan/reconstruction/mesh_fit_parts.hpp>

namespace turnscan::detail {

/// Looks vertices up in views, on all cores; those that face alike together, so that views which
/// see none of them are left out.
class MeshLook {
 public:
  explicit MeshLook(const TriangleMesh& mesh);

  /// Calls of context.advance() in a look.
  std::size_t blocks() const;

  /// Where they are now. spread: squared, as VertexColumns::spread; empty: 1.
  void place(const std::vector<Vec3f>& positions, const std::vector<Vec3f>& normals,
             const std::vector<float>& spread);

  /// Sums over every step-th view, by vertex, as VertexSums has them.
  struct Found {
    VertexMeasurements measured;
    std::vector<float> near;
  };
  Result<Found> look(std::span<const DepthView> views, std::size_t step, const MeshFitScale& scale,
                     const RunContext& context) const;

 private:
  /// A ball around the vertices of a block, and a cone around their normals.
  struct Patch {
    Vec3f center = Vec3f::Zero(), axis = Vec3f::Zero();
    float radius = 0.0f, opening = 0.0f;  // metres, radians
  };
  Patch patch(std::size_t begin, std::size_t end) const;
  static bool turned_away(const DepthView& view, const Patch& patch);
  static bool outside_window(const DepthView& view, const Patch& patch);

  std::vector<std::uint32_t> order_;  ///< place in the columns: vertex
  std::array<std::vector<float>, 7> columns_;
};

}  // namespace turnscan::detail
