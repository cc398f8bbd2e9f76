#pragma once
// Where a closed mesh came to pass through itself as its vertices moved, they go back.

#include <cstdint>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/mesh_refinement/mesh_fit_parts.hpp>
#include <vector>

namespace turnscan::mesh_refinement {

/// Whether any flag is set.
bool any_marked(const std::vector<std::uint8_t>& marks);

/// One flag per vertex: of triangles with winding_faults() of that spacing, but for those that had
/// some before.
std::vector<std::uint8_t> crossing_vertices(const TriangleMesh& mesh,
                                            const std::vector<std::uint8_t>& faults_before,
                                            double spacing_m);

/// Per vertex: 1 where marked, less by 1 / rings with each ring of neighbours, down to 0.
std::vector<float> fading_around(const MeshNeighbours& neighbours,
                                 const std::vector<std::uint8_t>& marked, int rings);

/// Draws vertices back to where they were (start, one per vertex) until no triangle has
/// winding_faults() of that spacing that had none with the vertices there: those of such triangles,
/// with their neighbours up to 6 rings less far, in steps of three tenths of their way and as often
/// as it takes, so that two sides of what is thin end up near each other. Where eight steps do not
/// help they go all the way, with 12 to 48 rings, and at last all vertices do. Fails with
/// kCancelled.
Result<> untangle(TriangleMesh& mesh, const std::vector<Vec3f>& start, double spacing_m,
                  const RunContext& context);

}  // namespace turnscan::mesh_refinement
