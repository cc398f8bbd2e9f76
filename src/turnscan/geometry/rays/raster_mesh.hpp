#pragma once
// The triangles of a scene in groups of neighbours, for rasterisation.

#include <array>
#include <turnscan/geometry/rays/triangle_clusters.hpp>
#include <vector>

namespace turnscan::sampling {

class RasterMesh {
 public:
  /// The result does not depend on the number of threads. Needs 46 bytes per triangle.
  static RasterMesh build(const std::vector<ObjectView>& objects);

  Clusters view() const;

 private:
  std::vector<float> corners_;
  std::array<std::vector<float>, kLevels> bounds_;
  std::array<int, kLevels> counts_{};
  std::vector<TriangleName> names_;
};

}  // namespace turnscan::sampling
