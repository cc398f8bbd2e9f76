#pragma once
// How far each vertex of a reconstructed mesh is expected to lie from the true surface.

#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::quality {

struct ErrorScale {
  double noise_m = 0.001;    ///< of a depth along its ray
  double spacing_m = 0.001;  ///< of the points of one frame
  double edge_m = 0.0005;    ///< MeshFitScale::edge_m
  bool filtered = false;     ///< the sensor averages over neighbouring pixels
};

/// Standard deviation of each vertex along its normal. support: of each vertex the sum of the
/// weights of its measurements (mesh_refinement::MeshFit). Where something was measured: noise
/// averaged over it, what pixels blur where the surface bends, and a floor; behind a sensor's own
/// filter also what it mixes where little is seen (at outlines), and a share of the distance
/// between pixels at walls thinner than two of them, of which measurements agree with each other on
/// a wrong surface. Elsewhere a share of the way along the surface to where something was. The
/// shares are fitted to simulated scans (bench/expected_error; docs/report.md).
std::vector<float> expected_errors(const TriangleMesh& mesh, const std::vector<float>& support,
                                   const ErrorScale& scale);

}  // namespace turnscan::quality
