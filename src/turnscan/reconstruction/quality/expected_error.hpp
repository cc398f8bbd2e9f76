#pragma once
// Expected distance of each vertex of a reconstructed mesh from the true surface.

#include <optional>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan::quality {

struct ErrorScale {
  double noise_m = 0.001;                            ///< of a depth value along its ray
  double spacing_m = 0.001;                          ///< of the points of one frame
  double edge_m = 0.0005;                            ///< MeshFitScale::edge_m
  bool filtered = false;                             ///< pixels are means over their neighbours
                                                     ///< (estimation/sensor_filter.hpp)
  std::optional<double> noise_share = std::nullopt;  ///< MeshFit::noise_share
};

/// Standard deviation of each vertex along its normal. support: for each vertex the sum of the
/// weights of its measurements (mesh_refinement::MeshFit). Where the surface was measured: the
/// noise that the fit left (MeshFit::noise_share), and the loss where the surface bends, which is
/// due to the fit (the stiffer, the more) or to a sensor's filter. Behind such a filter also the
/// mixing where little is seen (at outlines), and a share of the distance between pixels at walls
/// thinner than two of them, whose measurements agree with each other on a wrong surface. Elsewhere
/// a share of the distance along the surface to measured surface. The shares are fitted to
/// simulated scans (bench/expected_error; docs/reference/report.md).
std::vector<float> expected_errors(const TriangleMesh& mesh, const std::vector<float>& support,
                                   const ErrorScale& scale);

}  // namespace turnscan::quality
