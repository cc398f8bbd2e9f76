#pragma once
// Rigid registration: the iterative closest point method, point to plane.

#include <functional>
#include <span>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct IcpOptions {
  int max_iterations = 60;
  double max_distance_m = 0.01;  ///< pairs farther apart are not used
  double keep = 0.9;             ///< the nearest fraction of the pairs that is used (trimmed ICP)
  double min_overlap = 0.3;      ///< fail when fewer of the source points find a partner
  double tolerance_m = 1e-6;     ///< converged when no source point moves farther in a step
  double max_shift_m = 0.05;     ///< fail when the source's centre moves farther than this
  double max_turn_rad = 0.6;     ///< fail when the source turns farther than this
};
/// Fields icp-iterations, icp-distance, icp-keep, icp-overlap, icp-tolerance, icp-shift, icp-turn.
OptionTable describe(IcpOptions& options);

struct IcpResult {
  Pose T_target_source = Pose::Identity();
  double rms_m = 0.0;    ///< point to plane, over the pairs used in the last step
  double overlap = 0.0;  ///< fraction of source points with a partner within max_distance_m
  int iterations = 0;
};

/// A place on the target: a point and its unit normal. `found` is false where nothing is in reach.
struct IcpTarget {
  Vec3d point = Vec3d::Zero(), normal = Vec3d::Zero();
  bool found = false;
};
/// Nearest place on the target within max_distance_m of p_target; called from many threads.
using IcpLookup = std::function<IcpTarget(const Vec3d& p_target, double max_distance_m)>;

/// Moves source onto target, from `start` on. Each step minimises the sum of squared distances to
/// the tangent planes (Chen and Medioni 1991), over the nearest `keep` of the pairs, weighted by
/// Huber's function with the scale taken from the median (Huber 1981), with the smallest
/// eigenvalues of the system held (a sphere may turn, a plane may slide: such directions stay where
/// `start` had them). A result is returned only when converged; otherwise it fails with
/// kTooFewPoints (overlap too small), kLibrary (not converged, moved too far, or diverged; the
/// message says which), kCancelled. The same bytes for any number of threads.
Result<IcpResult> icp(std::span<const Vec3f> source, const IcpLookup& target, const Pose& start,
                      const IcpOptions& options, const RunContext& context);

/// Target: points with unit normals.
Result<IcpResult> icp(std::span<const Vec3f> source, std::span<const Vec3f> target_points,
                      std::span<const Vec3f> target_normals, const Pose& start,
                      const IcpOptions& options, const RunContext& context);

/// Target: a mesh; exact nearest points.
Result<IcpResult> icp(std::span<const Vec3f> source, const TriangleMesh& target, const Pose& start,
                      const IcpOptions& options, const RunContext& context);

}  // namespace turnscan
