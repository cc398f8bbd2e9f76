#pragma once
// Smoothing of whole meshes.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// The mesh with waves of the given length at half of their height: longer ones stay, shorter ones
/// vanish with the fourth power of their length (the implicit fairing of Desbrun et al. 1999,
/// "Implicit fairing of irregular meshes", of second order, so that large shapes do not shrink).
/// Connectivity and open edges stay where they are. Normals are recomputed. Uniform weights,
/// scaled by the edges about each vertex. Conjugate gradients, some (wavelength_m / edge)^2
/// iterations; waves of up to about 100 edges. The same bytes for any number of threads. Fails with
/// kLibrary when the system cannot be solved, and with kCancelled.
Result<TriangleMesh> low_pass(const TriangleMesh& mesh, double wavelength_m,
                              const RunContext& context);

}  // namespace turnscan
