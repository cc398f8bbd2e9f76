#include <turnscan/reconstruction/passes/motion_refinement.hpp>

#include <memory>
#include <turnscan/reconstruction/passes/coarse_alignment.hpp>
#include <turnscan/reconstruction/passes/merged_pass.hpp>
#include <turnscan/reconstruction/passes/pair_verdict.hpp>
#include <turnscan/reconstruction/passes/undetermined.hpp>

namespace turnscan::passes {

namespace {

/// Reach in each step, relative to the object's extent.
constexpr std::array<double, 8> kFirstReach{0.08, 0.08, 0.07, 0.06, 0.06, 0.05, 0.04, 0.03};
constexpr std::array<double, 8> kFinalReach{0.03, 0.03, 0.025, 0.02, 0.02, 0.015, 0.015, 0.015};
/// Reverting undetermined directions is linear; the second round starts near the end.
constexpr int kRounds = 2;

std::vector<double> scaled(std::span<const double> shares, double extent_m) {
  std::vector<double> out;
  for (const double share : shares) out.push_back(share * extent_m);
  return out;
}

Result<RefinedMotion> refine(const PreparedPass& whole, const PreparedPass& part, const Pose& start,
                             const JoinOptions& options, const RunContext& context) {
  const std::array<const PreparedPass*, 2> both{&whole, &part};
  const PassPair pair{0, 1};
  const double extent = std::max(whole.extent_m, part.extent_m);
  const double tolerance = agreement_tolerance_m(whole, part);
  RefinedMotion out;
  out.T_here_pass = start;
  for (int round = 0; round < kRounds; ++round) {
    Pose T = out.T_here_pass;
    if (round == 0) T = align_levels(whole.coarse, part.coarse, T, scaled(kFirstReach, extent));
    T = align_levels(whole.medium, part.medium, T, scaled(kFinalReach, extent));
    auto fine =
        adjust(both, std::span(&pair, 1), {Pose::Identity(), T}, 2.0 * tolerance, {}, context);
    TURNSCAN_TRY(context.check());
    if (!fine) {
      out.misfit = "their surfaces coincide nowhere near there";
      return out;
    }
    out.T_here_pass = determined_part(part, *fine, out.T_here_pass, options.max_sigma_m);
    out.sigma_rad = std::sqrt(fine->covariances[1].topLeftCorner<3, 3>().trace());
    out.sigma_m = surface_sigma(part, out.T_here_pass, fine->center, fine->covariances[1]);
  }
  const Agreement agreement = compare(whole, part, out.T_here_pass, tolerance, Density::kMedium);
  out.overlap_m2 = agreement.agreeing_m2;
  out.misfit = misfit(whole, part, agreement, options);
  return out;
}

}  // namespace

Result<RefinedMotion> refine_motion(std::span<const PlacedSurface> placed, const PassSurface& pass,
                                    const Pose& T_here_pass, const JoinOptions& options,
                                    const RunContext& context) {
  std::vector<std::unique_ptr<PreparedPass>> prepared;
  std::vector<const PreparedPass*> surfaces;
  std::vector<Pose> poses;
  for (const PlacedSurface& one : placed) {
    TURNSCAN_TRY(check_surface(*one.surface));
    prepared.push_back(std::make_unique<PreparedPass>(*one.surface));
    surfaces.push_back(prepared.back().get());
    poses.push_back(one.T_here_pass);
  }
  TURNSCAN_TRY(check_surface(pass));
  if (placed.empty()) throw std::invalid_argument("refine_motion: nothing is placed");
  const MergedPass whole(surfaces, poses);
  return refine(whole.prepared(), PreparedPass(pass), T_here_pass, options, context);
}

}  // namespace turnscan::passes
