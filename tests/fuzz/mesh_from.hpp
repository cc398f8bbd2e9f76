#pragma once
// A mesh that the bytes of an input describe.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::fuzz {

/// A tenth of the bytes are vertices of up to 1 km, the rest triangles of different vertices.
/// Precondition: size > 0.
inline TriangleMesh mesh_from(const std::uint8_t* data, std::size_t size) {
  TriangleMesh mesh;
  const std::size_t vertices = std::min<std::size_t>(3 + size / 20, 200);
  for (std::size_t v = 0; v < vertices; ++v) {
    std::array<std::int16_t, 3> c{};
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = static_cast<std::int16_t>(data[(6 * v + 2 * k) % size] << 8 |
                                       data[(6 * v + 2 * k + 1) % size]);
    mesh.vertices.push_back(Vec3f(c[0], c[1], c[2]) / 32.0f);
  }
  for (std::size_t i = 0; i + 2 < size && mesh.triangles.size() < 400; i += 3) {
    const auto n = static_cast<std::uint32_t>(vertices);
    const std::array<std::uint32_t, 3> t{data[i] % n, data[i + 1] % n, data[i + 2] % n};
    if (t[0] != t[1] && t[1] != t[2] && t[0] != t[2]) mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace turnscan::fuzz
