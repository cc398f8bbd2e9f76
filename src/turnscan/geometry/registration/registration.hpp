#pragma once
// Rigid registration by point-to-plane iterative closest points.

#include <functional>
#include <span>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/result.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/triangle_mesh.hpp>

namespace turnscan {

struct IcpOptions {
  int max_iterations = 60;
  double max_distance_m = 0.01;  ///< pairs farther apart are not used
  double keep = 0.9;             ///< the nearest fraction of the pairs is used (trimmed ICP)
  double min_overlap = 0.3;      ///< fail if a smaller fraction of the source finds a partner
  double tolerance_m = 2e-6;     ///< converged if a step moves no source point farther
  double max_shift_m = 0.05;     ///< fail if the centre of the source moves farther than this
  double max_turn_rad = 0.6;     ///< fail if the source rotates farther than this
};
/// Fields icp-iterations, icp-distance, icp-keep, icp-overlap, icp-tolerance, icp-shift, icp-turn.
OptionTable describe(IcpOptions& options);

struct IcpResult {
  Pose T_target_source = Pose::Identity();
  double rms_m = 0.0;    ///< point to plane, over the pairs used in the last step
  double overlap = 0.0;  ///< fraction of source points with a partner within max_distance_m
  int iterations = 0;
  /// Number of directions (of 6) that the surface does not constrain, and in which the source
  /// stayed where `start` had it: 3 for a sphere, 3 for a plane, 2 for a cylinder without ends.
  int held_directions = 0;
};

/// A point on the target and its unit normal (either orientation). `found` is false if nothing is
/// within reach.
struct IcpTarget {
  Vec3d point = Vec3d::Zero(), normal = Vec3d::Zero();
  bool found = false;
};
/// Nearest point on the target within max_distance_m of p_target; called from many threads.
using IcpLookup = std::function<IcpTarget(const Vec3d& p_target, double max_distance_m)>;

/// Aligns the source with the target, starting at `start`. Each step minimises the sum of squared
/// distances to the tangent planes (Chen and Medioni 1992) over the nearest `keep` of the pairs
/// (Chetverikov et al. 2002, trimmed ICP), weighted by Huber's function with its scale from the
/// median distance. Directions whose eigenvalue in the system is below a thousandth of the largest
/// are fixed, so that a round object does not drift. Source points that are not finite are ignored.
/// A result is always a converged one: otherwise fails with kTooFewPoints (fewer than 6 points, or
/// too small an overlap), kLibrary (not converged, or moved too far; the message says which and by
/// how much), kInvalidOption, kCancelled. The result is byte-identical for any number of threads.
Result<IcpResult> icp(std::span<const Vec3f> source, const IcpLookup& target, const Pose& start,
                      const IcpOptions& options, const RunContext& context);

/// Target: points with unit normals (kInvalidOption if their numbers differ).
Result<IcpResult> icp(std::span<const Vec3f> source, std::span<const Vec3f> target_points,
                      std::span<const Vec3f> target_normals, const Pose& start,
                      const IcpOptions& options, const RunContext& context);

/// Target: a mesh (kFormat as validate_mesh); exact nearest points, normals of triangles.
Result<IcpResult> icp(std::span<const Vec3f> source, const TriangleMesh& target, const Pose& start,
                      const IcpOptions& options, const RunContext& context);

}  // namespace turnscan
