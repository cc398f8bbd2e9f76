#pragma once
// The surface of objects divided into patches and grouped into cells.

#include <turnscan/simulator/coverage/coverage_map.hpp>

namespace turnscan::coverage {

/// Faces larger than a cell are halved at their longest edge until they are not.
class CoveragePatches {
 public:
  /// Divides the surface; enlarges cell_m if there would be too many patches.
  CoveragePatches(std::span<const TriangleMesh> objects, double cell_m);

  std::vector<CoveragePatch> patches;
  std::vector<CoverageCell> cells;     ///< area and centre are set
  std::vector<std::uint32_t> largest;  ///< largest patch of each cell
  double cell_m;

  bool has(std::uint32_t object, std::uint32_t triangle) const {
    return object + 1 < first_.size() && first_[object] + triangle < roots_.size();
  }
  /// Unit normal of a face; zero if it has no area.
  const Vec3f& normal(std::uint32_t object, std::uint32_t triangle) const {
    return normals_[first_[object] + triangle];
  }
  /// 0 to kAlbedoSteps - 1.
  std::uint8_t albedo_step(std::uint32_t object, std::uint32_t triangle) const {
    return albedo_[first_[object] + triangle];
  }
  /// The patch that contains a point of a face.
  std::uint32_t patch_at(std::uint32_t object, std::uint32_t triangle, const Vec3f& p) const;

  static constexpr int kAlbedoSteps = 16;

  /// Cube (three numbers) and direction of a patch.
  using CellKey = std::array<std::int64_t, 4>;

 private:
  /// A halved edge: the first child contains the edge's first corner.
  struct Node {
    int edge;
    std::array<std::int32_t, 2> child;  ///< a patch, or ~node
  };

  std::size_t count(std::span<const TriangleMesh> objects, double size) const;
  void cut(const TriangleMesh& mesh, std::uint32_t object);
  std::int32_t cut(const std::array<Vec3f, 3>& corners, std::uint32_t object, std::uint32_t face);
  void gather();
  std::vector<std::uint32_t> place_by_key(std::vector<CellKey>& keys,
                                          std::vector<double>& areas) const;

  std::vector<std::size_t> first_;   ///< index in roots_ of the first face of each object, and the
                                     ///< end
  std::vector<std::int32_t> roots_;  ///< per face: a patch, or ~node
  std::vector<Vec3f> normals_;
  std::vector<std::uint8_t> albedo_;
  std::vector<Node> nodes_;
  std::span<const TriangleMesh> objects_;
};

}  // namespace turnscan::coverage
