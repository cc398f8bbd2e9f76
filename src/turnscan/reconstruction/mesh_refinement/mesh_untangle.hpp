#pragma once
// Removes self-intersections that arose in a closed mesh as its vertices moved.

#include <cstdint>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>
#include <vector>

namespace turnscan::mesh_refinement {

/// Whether any flag is set.
bool any_marked(const std::vector<std::uint8_t>& marks);

/// One flag per triangle: whether a corner has a value greater than 0.
template <class T>
std::vector<std::uint8_t> triangles_at(const TriangleMesh& mesh, const std::vector<T>& values) {
  std::vector<std::uint8_t> out;
  out.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles)
    out.push_back(values[a] > T(0) || values[b] > T(0) || values[c] > T(0) ? 1 : 0);
  return out;
}

/// Moves the loose vertices (one flag each; empty: all are) until no triangle at them has
/// self_intersections(). First those of such triangles back towards their start positions (one per
/// vertex), and their neighbours up to 6 rings away to a lesser degree, in steps of three tenths of
/// their displacement and as often as needed, so that the two sides of a thin part end up close to
/// each other. If 24 steps do not suffice, they move all the way, with 12 to 48 rings, and finally
/// all do. What crossed at the start, too, is averaged with its neighbours, in up to 24 rings; if
/// the loose vertices alone do not suffice for that, the others move as well. Fails with
/// kCancelled.
Result<> untangle(TriangleMesh& mesh, const std::vector<Vec3f>& start,
                  const std::vector<std::uint8_t>& loose, const RunContext& context);

}  // namespace turnscan::mesh_refinement
