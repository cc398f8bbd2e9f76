#pragma once
// The last step but the picture: no more triangles than are asked for, or than the surface is
// worth.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/options.hpp>
#include <turnscan/reconstruction/result.hpp>

namespace turnscan::finishing {

/// Simplifies the objects' meshes as options.finish says, checks them again, and says in the
/// choices what was done and why. What is known of vertices and triangles stays with the surface:
/// a vertex has the mean of the quality around it, weighted by area, and its own confidence.
/// By default triangles are as few as an eighth of the median expected error of what was measured
/// allows (the root mean square that quadrics estimate), a quarter of a voxel at most, and no
/// vertex of the full mesh lies farther off than half a voxel; where colours are at the vertices
/// all stay. Where a bound is on the distance, triangles at the borders of what was measured stay.
/// Fails as simplify() does, and with kInvalidOption and kCancelled.
Result<> reduce_triangles(const ReconstructOptions& options, Reconstruction& reconstruction,
                          const RunContext& context);

}  // namespace turnscan::finishing
