#pragma once

#include <numbers>
#include <tests/reconstruction/turning_scan.hpp>

namespace turnscan::testing {

/// A ball of rings of quads, closed by a fan at each pole.
inline TriangleMesh ball_mesh() {
  constexpr std::uint32_t kRings = 90, kAround = 180;
  TriangleMesh mesh;
  for (std::uint32_t r = 1; r < kRings; ++r) {
    for (std::uint32_t a = 0; a < kAround; ++a) {
      const double up = std::numbers::pi * r / kRings, turn = 2.0 * std::numbers::pi * a / kAround;
      const Vec3d n(std::sin(up) * std::cos(turn), std::cos(up), std::sin(up) * std::sin(turn));
      mesh.vertices.push_back((kCenter + kRadius * n).cast<float>());
      if (r + 1 == kRings) continue;
      const std::uint32_t v = (r - 1) * kAround + a, beside = v - a + (a + 1) % kAround;
      mesh.triangles.push_back({v, beside, v + kAround});
      mesh.triangles.push_back({beside, beside + kAround, v + kAround});
    }
  }
  const auto top = std::uint32_t(mesh.vertices.size()), bottom = top + 1, last = top - kAround;
  for (const double y : {kRadius, -kRadius})
    mesh.vertices.push_back((kCenter + Vec3d(0.0, y, 0.0)).cast<float>());
  for (std::uint32_t a = 0; a < kAround; ++a) {
    const std::uint32_t beside = (a + 1) % kAround;
    mesh.triangles.push_back({top, beside, a});
    mesh.triangles.push_back({bottom, last + a, last + beside});
  }
  return mesh;
}

}  // namespace turnscan::testing
