#pragma once
// Mesh simplification, the last step before texturing: at most the requested number of triangles,
// or as many as the accuracy of the surface warrants.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan::finishing {

/// Simplifies the objects' meshes as options.finish requests, checks them again, and records in the
/// choices what was done and why. Attributes of vertices and triangles stay with the surface: a
/// vertex gets the area-weighted mean of the quality around it, and keeps its confidence.
/// By default, the triangles are as few as an eighth of the median expected error of the measured
/// surface allows (root mean square as estimated by quadrics), but at most a quarter of a voxel
/// (a twentieth where the error is not known), and no vertex of the full mesh is more than half a
/// voxel from the result; with vertex colours all triangles are kept. With a bound on the distance,
/// triangles at the borders of the measured surface are kept. Fails as simplify() does, and with
/// kInvalidOption and kCancelled.
Result<> reduce_triangles(const ReconstructOptions& options, Reconstruction& reconstruction,
                          const RunContext& context);

}  // namespace turnscan::finishing
