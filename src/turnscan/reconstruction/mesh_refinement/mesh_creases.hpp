#pragma once
// Creases of a fitted mesh: straight lines at which two planes meet.

#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <vector>

namespace turnscan::mesh_refinement {

/// Moves the measured vertices beside creases onto the two planes that meet there, and those next
/// to the line in which they meet onto it (L. Kobbelt et al., "Feature sensitive surface extraction
/// from volume data", 2001, section 3). The planes are fitted robustly to the vertices around,
/// those closest to the line left out: an extracted surface cuts an edge off, and the sensor and
/// the fit round it. There is a crease where two planes explain the vertices around better than one
/// quadratic surface, which has as many parameters, and meet at 30 to 150 degrees. support: of the
/// fit, per vertex. Triangles are unchanged; no vertex moves by more than 0.7 of the mean edge, and
/// no step rotates a triangle by more than 73 degrees. The mesh must be closed. Fails with
/// kCancelled; then nothing has moved.
Result<> straighten_creases(TriangleMesh& mesh, const std::vector<float>& support,
                            const RunContext& context);

}  // namespace turnscan::mesh_refinement
