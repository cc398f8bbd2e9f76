#pragma once
// The triangles of a scene in groups of neighbours, as they are drawn (private).

#include <array>
#include <turnscan/simulator/sample_kernel.hpp>
#include <vector>

namespace turnscan {

class RasterMesh {
 public:
  /// The same for every number of threads. Needs 46 bytes a triangle.
  static RasterMesh build(const std::vector<sampling::ObjectView>& objects);

  sampling::Clusters view() const;

 private:
  std::vector<float> corners_;
  std::array<std::vector<float>, sampling::kLevels> bounds_;
  std::array<int, sampling::kLevels> counts_{};
  std::vector<sampling::TriangleName> names_;
};

}  // namespace turnscan
