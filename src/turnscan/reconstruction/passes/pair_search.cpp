#include <turnscan/reconstruction/passes/pair_search.hpp>

#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/passes/coarse_alignment.hpp>
#include <turnscan/reconstruction/passes/motion_votes.hpp>

namespace turnscan::passes {

namespace {

constexpr std::size_t kVoted = 800, kRefined = 40, kKept = 12;
/// If the shape leaves the motion undetermined, many motions fit equally, and colours choose among
/// them.
constexpr std::size_t kColored = 2;
/// Reach in each step, relative to the object's extent. A rotation of the grid is wrong by up to 10
/// degrees.
constexpr std::array<double, 12> kCoarseReach{0.11, 0.10, 0.09, 0.08, 0.07, 0.06,
                                              0.05, 0.05, 0.04, 0.04, 0.03, 0.03};
constexpr std::array<double, 8> kMediumReach{0.03, 0.03, 0.025, 0.02, 0.02, 0.015, 0.015, 0.015};
constexpr double kCoarseTolerance = 0.015;

/// Refines and ranks the motions, and keeps the best clearly different ones.
struct Refinement {
  const PreparedPass& a;
  const PreparedPass& b;
  const ColorScale& colors;
  const RunContext& context;

  Result<> run(std::vector<CandidateMotion>& motions, Density density,
               std::span<const double> shares, double tolerance_m, std::size_t keep) const {
    const bool coarse = density == Density::kCoarse;
    const SurfaceLevel& of_a = coarse ? a.coarse : a.medium;
    const SurfaceLevel& of_b = coarse ? b.coarse : b.medium;
    std::vector<double> reaches;
    for (const double share : shares) reaches.push_back(share * std::max(a.extent_m, b.extent_m));
    TURNSCAN_TRY(parallel_for(motions.size(), 1, context, [&](std::size_t i) {
      CandidateMotion& motion = motions[i];
      motion.T_a_b = align_levels(of_a, of_b, motion.T_a_b, reaches, colors.spread);
      motion.agreement = compare(a, b, motion.T_a_b, tolerance_m, density);
      if (colors.any())
        motion.colors = compare_colors(a, b, motion.T_a_b, colors, tolerance_m, density);
    }));
    std::stable_sort(motions.begin(), motions.end(),
                     [](const CandidateMotion& x, const CandidateMotion& y) {
                       return x.evidence_m2() > y.evidence_m2();
                     });
    keep_different(motions, keep);
    return {};
  }

  void keep_different(std::vector<CandidateMotion>& motions, std::size_t keep) const {
    std::vector<CandidateMotion> kept;
    for (CandidateMotion& motion : motions) {
      if (kept.size() == keep) break;
      if (std::none_of(kept.begin(), kept.end(), [&](const CandidateMotion& other) {
            return motion_distance(b, motion.T_a_b, other.T_a_b) < same_motion_m(a, b);
          }))
        kept.push_back(std::move(motion));
    }
    motions = std::move(kept);
  }
};

}  // namespace

double same_motion_m(const PreparedPass& a, const PreparedPass& b) {
  return 0.02 * std::max(a.extent_m, b.extent_m);
}

double agreement_tolerance_m(const PreparedPass& a, const PreparedPass& b) {
  // The average of many frames is several times more accurate than one of them.
  return std::max(a.surface->noise_m, b.surface->noise_m) + 0.0005;
}

Result<std::vector<CandidateMotion>> search_motions(const PreparedPass& a, const PreparedPass& b,
                                                    const ColorScale& colors,
                                                    const RunContext& context) {
  const double extent = std::max(a.extent_m, b.extent_m);
  TURNSCAN_ASSIGN(const auto voted, vote_motions(a.votes.samples, b.votes.samples, extent, kVoted,
                                                 colors.spread, context));
  std::vector<CandidateMotion> motions(voted.size());
  for (std::size_t i = 0; i < voted.size(); ++i) motions[i].T_a_b = voted[i].T_a_b;
  const Refinement refinement{a, b, colors, context};
  const std::size_t more = colors.any() ? kColored : 1;
  TURNSCAN_TRY(refinement.run(motions, Density::kCoarse, kCoarseReach, kCoarseTolerance * extent,
                              more * kRefined));
  TURNSCAN_TRY(refinement.run(motions, Density::kMedium, kMediumReach, agreement_tolerance_m(a, b),
                              more * kKept));
  return motions;
}

}  // namespace turnscan::passes
