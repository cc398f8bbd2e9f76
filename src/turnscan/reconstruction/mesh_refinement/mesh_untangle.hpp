#pragma once
// Removes self-intersections that arose in a closed mesh as its vertices moved.

#include <cstdint>
#include <span>
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

/// One flag per vertex: those of triangles with self_intersections(), except triangles that had
/// some before (empty: none had). moved: as for self_intersections().
std::vector<std::uint8_t> crossing_vertices(const TriangleMesh& mesh,
                                            const std::vector<std::uint8_t>& before,
                                            std::span<const std::uint8_t> moved = {});

/// Per vertex: 1 if marked, less by 1 / rings with each ring of neighbours, down to 0.
std::vector<float> fading_around(const MeshNeighbours& neighbours,
                                 const std::vector<std::uint8_t>& marked, int rings);

/// Moves vertices back towards their start positions (one per vertex) until no triangle has
/// self_intersections() except those that had some at the start: the vertices of such triangles,
/// and their neighbours up to 6 rings away to a lesser degree, in steps of three tenths of their
/// displacement and as often as needed, so that the two sides of a thin part end up close to each
/// other. If 24 steps do not suffice, they move all the way, with 12 to 48 rings, and finally
/// all vertices do. Fails with kCancelled.
Result<> untangle(TriangleMesh& mesh, const std::vector<Vec3f>& start, const RunContext& context);

/// Averages the loose vertices (one flag each) of triangles with self_intersections(), and to a
/// lesser degree those of up to 24 rings around them, with their neighbours until there are none:
/// where no start is known that had none. If some remain, nothing moves. Fails with kCancelled.
Result<> smooth_crossings(TriangleMesh& mesh, const std::vector<std::uint8_t>& loose,
                          const RunContext& context);

}  // namespace turnscan::mesh_refinement
