#pragma once
// How far each vertex of a reconstructed mesh is expected to lie from the true surface.

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::quality {

/// What the pixels of a sensor see of the surface.
enum class Pixels {
  kSharp,     ///< the place that they look at
  kRagged,    ///< places beside it, others in each frame (estimation/silhouette_roughness.hpp)
  kFiltered,  ///< the mean over their neighbours (estimation/sensor_filter.hpp)
};

struct ErrorScale {
  double noise_m = 0.001;    ///< of a depth along its ray
  double spacing_m = 0.001;  ///< of the points of one frame
  double edge_m = 0.0005;    ///< MeshFitScale::edge_m
  Pixels pixels = Pixels::kSharp;
};

/// Standard deviation of each vertex along its normal. support: of each vertex the sum of the
/// weights of its measurements (mesh_refinement::MeshFit). Where something was measured: noise
/// averaged over it, a floor, and what is lost where the surface bends: to the fit, the stiffer it
/// is; to pixels that see places beside theirs; or to a sensor's own filter. Behind such a filter
/// also what it mixes where little is seen (at outlines), and a share of the distance between
/// pixels at walls thinner than two of them, of which measurements agree with each other on a wrong
/// surface. Elsewhere a share of the way along the surface to where something was. The shares are
/// fitted to simulated scans (bench/expected_error; docs/report.md).
std::vector<float> expected_errors(const TriangleMesh& mesh, const std::vector<float>& support,
                                   const ErrorScale& scale);

}  // namespace turnscan::quality
