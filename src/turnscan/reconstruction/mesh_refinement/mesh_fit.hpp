#pragma once
// Mesh refinement: moves vertices along their normals to the surface that all depth frames together
// indicate.

#include <functional>
#include <optional>
#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>
#include <turnscan/reconstruction/views/depth_view.hpp>

namespace turnscan::mesh_refinement {

struct MeshFitScale {
  double noise_m = 0.001;   ///< of a depth value along its ray
  double reach_m = 0.0013;  ///< reach across the normal; measurements beyond it are ignored
  double floor_m = 0.0002;  ///< of errors that do not decrease with the incidence angle
  /// Least bending stiffness of the surface relative to the measurements. The fit raises it up to
  /// 256 times wherever the measurements of independent groups of views allow.
  double stiffness = 15.0;
  /// Curvature, averaged with the neighbours', in standard deviations of the noise, at which the
  /// weight of the bending term falls to a quarter: larger ones are creases.
  double crease_sigmas = 0.1;
  /// Weight, in measurements, with which vertices on a crease follow their neighbours.
  double crease_coupling = 8.0;
  double fair_m = 0.0;     ///< unmeasured surface is faired; maximum motion of its vertices
  double limit_m = 0.002;  ///< maximum motion of a vertex in one iteration
  float edge_weight = 0.1f;
  int iterations = 3;                    ///< 0: only computes the support
  std::optional<double> floor_height_m;  ///< vertices below it move only sideways with the others
  /// Where all the same the object was measured below that height; empty: nowhere.
  std::function<bool(const Vec3f& vertex)> measured_below;
};

struct MeshFit {
  TriangleMesh mesh;
  std::vector<float> support;  ///< per vertex: sum of the weights of its measurements
  /// Standard deviation of the fitted surface over noise_m / sqrt(1 + support), median over the
  /// vertices, as far as views from different directions (30 degrees each) err independently:
  /// noise, poses, and what a sensor measures differently from different sides. By balanced
  /// repeated replication (P. McCarthy, "Replication: an approach to the analysis of data from
  /// complex surveys", 1966). nullopt: no place was seen from two directions, or nothing was
  /// fitted.
  std::optional<double> noise_share;
};

/// Median of the non-zero supports.
float typical_support(const std::vector<float>& support);
/// Share of the typical support from which on a vertex was measured.
inline constexpr float kMeasuredShare = 0.02f;
/// How far each vertex was measured: its support over that share of the typical one, at most 1.
std::vector<float> measured_shares(const std::vector<float>& support);
/// Those with a share below 1, one flag per vertex.
std::vector<std::uint8_t> unseen_vertices(const std::vector<float>& support);

/// Minimises over offsets along the normals the robust (Tukey) squares of the distances between the
/// measurements around each vertex and its tangent plane, in the views that face it, and a bending
/// term, which averages noise where the surface is smooth, fades at edges, and dominates where
/// there are few measurements. Triangles are unchanged; no step towards the measurements rotates
/// one by more than 73 degrees (fairing of unmeasured surface may). Fails with kCancelled. The
/// result is byte-identical for any number of threads.
Result<MeshFit> fit_mesh(const TriangleMesh& mesh, std::span<const views::DepthView> views,
                         const MeshFitScale& scale, const RunContext& context);

}  // namespace turnscan::mesh_refinement
