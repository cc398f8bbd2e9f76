#pragma once
// Smoothing of whole meshes.

#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

/// Low-pass filter that halves the amplitude of waves of the given length: longer ones are
/// preserved, shorter ones vanish with the fourth power of their length (the implicit fairing of
/// Desbrun et al. 1999, "Implicit fairing of irregular meshes", of second order, so that large
/// shapes do not shrink). Connectivity and boundary edges are unchanged. Normals are recomputed.
/// Uniform weights, scaled by the edges around each vertex. Conjugate gradients, some (wavelength_m
/// / edge)^2 iterations; waves of up to about 100 edges. The result is byte-identical for any
/// number of threads. Fails with kLibrary if the system cannot be solved, and with kCancelled.
Result<TriangleMesh> low_pass(const TriangleMesh& mesh, double wavelength_m,
                              const RunContext& context);

}  // namespace turnscan
