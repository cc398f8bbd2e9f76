#pragma once

#include <turnscan/core/point_cloud.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::surface {

inline constexpr const char* kConcaveHullProgram = "turnscan-concave-hull";

/// Concave hull (alpha shape; geometry/hull/alpha_shape.hpp), which in general is not 2-manifold.
/// Runs in the helper program, so that it can be cancelled at any moment. Fails with kTooFewPoints
/// (fewer than 10), kLibrary (it crashed or gave no triangle), kResourceLimit, kMissingData
/// (find_helper_program), kIo (it cannot be started), kCancelled.
Result<TriangleMesh> concave_hull(const PointCloud& points, double alpha_m,
                                  const RunContext& context);

}  // namespace turnscan::surface
