#include <turnscan/reconstruction/passes/pair_search.hpp>

#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/reconstruction/passes/coarse_alignment.hpp>
#include <turnscan/reconstruction/passes/motion_votes.hpp>

namespace turnscan::passes {

namespace {

constexpr std::size_t kVoted = 800;
/// If the shape leaves the motion undetermined, many motions fit equally, and colours choose among
/// them.
constexpr std::size_t kColored = 2;

/// Reach in each step, relative to the object's extent. A rotation of the grid is wrong by up to 10
/// degrees.
constexpr std::array<double, 5> kFirst{0.11, 0.10, 0.09, 0.08, 0.07};
constexpr std::array<double, 4> kNearer{0.06, 0.05, 0.05, 0.04};
constexpr std::array<double, 3> kEnd{0.04, 0.03, 0.03};
constexpr std::array<double, 3> kMediumFirst{0.03, 0.03, 0.025};
constexpr std::array<double, 5> kMediumEnd{0.02, 0.02, 0.015, 0.015, 0.015};

/// Steps after which only the best and clearly different motions go on: most of those voted for end
/// together or nowhere, which some of the points show after a few steps.
struct Round {
  Density density;
  std::span<const double> reaches;
  std::size_t stride;  ///< of the points that are paired
  std::size_t keep;
};
constexpr std::array<Round, 5> kRounds{{{Density::kCoarse, kFirst, 2, 200},
                                        {Density::kCoarse, kNearer, 1, 80},
                                        {Density::kCoarse, kEnd, 1, 40},
                                        {Density::kMedium, kMediumFirst, 2, 16},
                                        {Density::kMedium, kMediumEnd, 1, 12}}};
constexpr double kCoarseTolerance = 0.015;

/// Refines and ranks the motions, and keeps the best clearly different ones.
struct Refinement {
  const PreparedPass& a;
  const PreparedPass& b;
  const ColorScale& colors;
  const RunContext& context;

  Result<> run(std::vector<CandidateMotion>& motions, const Round& round) const {
    const double extent = std::max(a.extent_m, b.extent_m);
    const bool coarse = round.density == Density::kCoarse;
    const double tolerance_m = coarse ? kCoarseTolerance * extent : agreement_tolerance_m(a, b);
    const SurfaceLevel& of_a = coarse ? a.coarse : a.medium;
    const SurfaceLevel& of_b = coarse ? b.coarse : b.medium;
    std::vector<double> reaches;
    for (const double share : round.reaches) reaches.push_back(share * extent);
    TURNSCAN_TRY(parallel_for(motions.size(), 1, context, [&](std::size_t i) {
      CandidateMotion& motion = motions[i];
      motion.T_a_b = align_levels(of_a, of_b, motion.T_a_b, reaches, colors.spread, round.stride);
      motion.agreement = compare(a, b, motion.T_a_b, tolerance_m, round.density);
      if (colors.any())
        motion.colors = compare_colors(a, b, motion.T_a_b, colors, tolerance_m, round.density);
    }));
    std::stable_sort(motions.begin(), motions.end(),
                     [](const CandidateMotion& x, const CandidateMotion& y) {
                       return x.evidence_m2() > y.evidence_m2();
                     });
    keep_different(motions, (colors.any() ? kColored : 1) * round.keep);
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
  for (const Round& round : kRounds) TURNSCAN_TRY(refinement.run(motions, round));
  return motions;
}

}  // namespace turnscan::passes
