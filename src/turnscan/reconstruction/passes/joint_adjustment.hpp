#pragma once
// The motions of all passes at once, from all of their measured surface.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

/// Two passes whose surfaces overlap, by number.
struct PassPair {
  std::size_t a = 0, b = 0;
  bool by_colors = false;  ///< their colours are brought together, too; both have some
};

struct Adjustment {
  std::vector<Pose> T_first_pass;    ///< one a pass; that of the first is the identity
  std::vector<Matrix6> covariances;  ///< of each: of a rotation vector, then a translation, which
                                     ///< follow the motion, about `center`, in the first's frame
  std::vector<Matrix6> information;  ///< of each with all others held, without the scatter's scale
  Vec3d center = Vec3d::Zero();
  double sigma_m = 0.0;   ///< robust deviation of the distances between the surfaces
  std::size_t pairs = 0;  ///< of points, in the last step
};

/// How much work is put in.
struct AdjustEffort {
  std::size_t sources = 20000;  ///< points of a pass that look for partners in another
  int iterations = 20;
};

/// Minimises Tukey's function of the distances between each point and the nearest tangent plane of
/// the other pass, in both directions, over all pairs of passes. The covariance counts what lies
/// together on the surface as one measurement: neighbours share their errors. Differences of
/// colour pull along the surface, weighed by their own scatter, after a ShadingFit.
/// Fails with kTooFewPoints where a pass has no partners, and with kCancelled.
Result<Adjustment> adjust(std::span<const PreparedPass* const> passes,
                          std::span<const PassPair> pairs, std::vector<Pose> T_first_pass,
                          double reach_m, const AdjustEffort& effort, const RunContext& context);

}  // namespace turnscan::passes
