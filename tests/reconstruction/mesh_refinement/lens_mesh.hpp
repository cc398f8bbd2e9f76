#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::testing {

inline constexpr int kSheetRings = 30, kSheetAround = 96;
inline constexpr float kSheetRing_m = 0.001f;

/// A closed body of two discs of rings, one over the other, with heights by the distance from the
/// axis, joined at their outline. First the upper disc's vertices, its middle the first of them.
inline TriangleMesh lens(const std::function<float(float)>& height) {
  TriangleMesh mesh;
  for (const float side : {1.0f, -1.0f}) {
    mesh.vertices.emplace_back(0.0f, side * height(0.0f), 0.0f);
    for (int r = 1; r <= kSheetRings; ++r) {
      for (int a = 0; a < kSheetAround; ++a) {
        const double turn = 2.0 * std::numbers::pi * a / kSheetAround;
        const float radius = kSheetRing_m * float(r);
        mesh.vertices.emplace_back(radius * float(std::cos(turn)), side * height(radius),
                                   radius * float(std::sin(turn)));
      }
    }
  }
  const auto half = std::uint32_t(1 + kSheetRings * kSheetAround);
  const auto at = [&](int r, int a) {
    return r == 0 ? 0u : std::uint32_t(1 + (r - 1) * kSheetAround + a % kSheetAround);
  };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({half + a, half + c, half + b});
  };
  for (int r = 0; r < kSheetRings; ++r) {
    for (int a = 0; a < kSheetAround; ++a) {
      add(at(r, a), at(r + 1, a + 1), at(r + 1, a));
      if (r > 0) add(at(r, a), at(r, a + 1), at(r + 1, a + 1));
    }
  }
  for (int a = 0; a < kSheetAround; ++a) {
    const std::uint32_t p = at(kSheetRings, a), q = at(kSheetRings, a + 1);
    mesh.triangles.push_back({p, q, half + p});
    mesh.triangles.push_back({q, half + q, half + p});
  }
  return mesh;
}

}  // namespace turnscan::testing
