#pragma once
// What every reader promises about what it returns, for fuzz targets.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/io/cloud/cloud_io.hpp>
#include <vector>

#include "tests/fuzz/fuzz_target.hpp"

namespace turnscan::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

inline void require(bool promise, const char* what) {
  if (promise) return;
  std::fprintf(stderr, "broken promise: %s\n", what);
  std::abort();
}

inline bool fits(std::size_t attribute, std::size_t points) {
  return attribute == 0 || attribute == points;
}

inline void check(const std::vector<TriangleMesh>& meshes) {
  for (const TriangleMesh& mesh : meshes) {
    const std::size_t n = mesh.vertices.size();
    require(fits(mesh.normals.size(), n) && fits(mesh.colors.size(), n), "length of an attribute");
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t index : triangle) require(index < n, "index of a vertex");
  }
}

inline void check(const CloudFile& file) {
  const std::size_t n = file.cloud.size();
  require(fits(file.cloud.normals.size(), n) && fits(file.cloud.colors.size(), n) &&
              fits(file.cloud.weights.size(), n) && fits(file.cloud.frame.size(), n),
          "length of an attribute");
  for (const Vec3f& point : file.cloud.points) require(point.allFinite(), "finite points");
  require(file.grid.size() == std::size_t(file.grid_width) * std::size_t(file.grid_height),
          "size of the grid");
  for (const std::int32_t cell : file.grid)
    require(cell >= -1 && cell < static_cast<std::int64_t>(n), "cell of the grid");
}

}  // namespace turnscan::fuzz
