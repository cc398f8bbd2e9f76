#pragma once
// Joint estimation of the motions of all passes from all of their measured surface.

#include <span>
#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/passes/prepared_pass.hpp>

namespace turnscan::passes {

/// Two passes whose surfaces overlap, by index.
struct PassPair {
  std::size_t a = 0, b = 0;
  bool by_colors = false;  ///< their colours are matched, too; both have some
};

struct Adjustment {
  std::vector<Pose> T_first_pass;    ///< one per pass; that of the first is the identity
  std::vector<Matrix6> covariances;  ///< of each: of a rotation vector, then a translation, which
                                     ///< follow the motion, about `center`, in the first's frame
  std::vector<Matrix6> information;  ///< of each with all others fixed, not scaled by the scatter
  Vec3d center = Vec3d::Zero();
  double sigma_m = 0.0;   ///< robust standard deviation of the distances between the surfaces
  std::size_t pairs = 0;  ///< number of point pairs in the last step
};

/// Computational effort.
struct AdjustEffort {
  std::size_t sources = 20000;  ///< points of a pass that are matched to another
  int iterations = 20;
};

/// Minimises Tukey's function of the distances between each point and the nearest tangent plane of
/// the other pass, in both directions, over all pairs of passes. The covariance counts nearby
/// points of the surface as one measurement, since neighbours share their errors. Differences of
/// colour constrain motion along the surface, weighted by their own scatter, after a ShadingFit.
/// Fails with kTooFewPoints if a pass has no partners, and with kCancelled.
Result<Adjustment> adjust(std::span<const PreparedPass* const> passes,
                          std::span<const PassPair> pairs, std::vector<Pose> T_first_pass,
                          double reach_m, const AdjustEffort& effort, const RunContext& context);

}  // namespace turnscan::passes
