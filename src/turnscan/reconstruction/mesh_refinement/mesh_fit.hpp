#pragma once
// Refinement of a mesh: vertices move along their normals to where all depth frames together say
// the surface is.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::mesh_refinement {

struct MeshFitScale {
  double noise_m = 0.001;  ///< of a depth along its ray
  /// Noise of means over many pixels, over that of means of independent ones: more than 1 where a
  /// filter gave neighbours errors in common (estimation/sensor_filter.hpp).
  double correlation = 1.0;
  double spacing_m = 0.0024;  ///< of the points of one frame
  double edge_m = 0.001;      ///< usual length of the mesh's edges
  double reach_m = 0.0013;    ///< measurements farther across the normal do not count
  double floor_m = 0.0002;    ///< of errors that do not fall with the angle of incidence
  /// Of the surface against bending otherwise than around, relative to the measurements; more where
  /// few and noisy ones leave more noise.
  double stiffness = 15.0;
  /// Curvature, averaged with the neighbours', in deviations of the noise, at which the weight of
  /// the bending term falls to a quarter: larger ones are creases.
  double crease_sigmas = 0.1;
  /// Weight, in measurements, with which vertices on a crease move as their neighbours do.
  double crease_coupling = 8.0;
  double fair_m = 0.0;     ///< what was not measured is faired; vertices move at most so far
  double limit_m = 0.002;  ///< a vertex moves at most so far in one iteration
  float edge_weight = 0.1f;
  int iterations = 3;                    ///< 0: only measures the support
  std::optional<double> floor_height_m;  ///< vertices below it move only sideways with the others
};

struct MeshFit {
  TriangleMesh mesh;
  std::vector<float> support;  ///< per vertex: sum of the weights of its measurements
};

/// Median of the supports that there are.
float typical_support(const std::vector<float>& support);
/// Share of the typical support below which a vertex counts as seen by no view.
inline constexpr float kUnseenShare = 0.02f;
/// The vertices that so count, one flag each.
std::vector<std::uint8_t> unseen_vertices(const std::vector<float>& support);

/// How many times MeshFitScale::stiffness the fit takes, 1 to 32: what noise leaves of the
/// measurements falls with their number, and what a surface bends does not. Errors that neighbours
/// have in common leave waves wider than the mesh's edges, which need more of it the larger they
/// are. Longer edges are stiffer as they are.
double stiffening(double noise_m, double correlation, double spacing_m, double edge_m,
                  float typical_support);

/// Minimises over offsets along the normals the robust (Tukey) squares of the distances between
/// the measurements around each vertex and its tangent plane, of the views that face it, and a
/// bending term, which averages noise away where the surface is smooth, fades at edges, and decides
/// where few measurements are. Triangles stay as they are; no step towards the measurements turns
/// one by more than 73 degrees (fairing what was not measured may). Fails with kCancelled. The same
/// bytes for any number of threads.
Result<MeshFit> fit_mesh(const TriangleMesh& mesh, std::span<const views::DepthView> views,
                         const MeshFitScale& scale, const RunContext& context);

}  // namespace turnscan::mesh_refinement
