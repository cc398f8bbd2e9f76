#include <algorithm>
#include <cmath>
#include <memory>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/passes/pair_verdict.hpp>
#include <turnscan/reconstruction/passes/undetermined.hpp>

namespace turnscan::passes {

namespace {

constexpr std::size_t kFewestPoints = 200;

Result<> check_passes(std::span<const PassSurface> passes) {
  if (passes.size() < 2)
    return fail(ErrorCode::kTooFewPoints, "join passes: there are {}, two are needed",
                passes.size());
  for (std::size_t k = 0; k < passes.size(); ++k) {
    const std::size_t points = passes[k].points.size();
    if (points < kFewestPoints)
      return fail(ErrorCode::kTooFewPoints,
                  "join passes: pass {} has {} measured points, {} are needed", k, points,
                  kFewestPoints);
    if (passes[k].normals.size() != points || passes[k].areas.size() != points ||
        passes[k].weights.size() != points)
      throw std::invalid_argument("join_passes: normals, areas and weights must fit the points");
  }
  return {};
}

class PassJoin {
 public:
  PassJoin(const JoinOptions& options, const RunContext& context)
      : options_(options), context_(context) {}

  Result<std::vector<PassMotion>> run(std::span<const PassSurface> passes) {
    const std::size_t n = passes.size();
    context_.begin_phase("join passes", n * (n - 1) / 2 + 1);
    for (const PassSurface& pass : passes)
      prepared_.push_back(std::make_unique<PreparedPass>(pass));
    motions_.resize(n);
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b) {
        TURNSCAN_ASSIGN(PairVerdict verdict,
                        judge_pair(*prepared_[a], *prepared_[b], options_, context_));
        verdicts_.push_back({{a, b}, std::move(verdict)});
        context_.advance();
      }
    }
    grow_from_first();
    TURNSCAN_TRY(adjust_joined());
    return std::move(motions_);
  }

 private:
  struct JudgedPair {
    PassPair pair;
    PairVerdict verdict;
  };

  /// Joins passes to those that are, the surest pair first.
  void grow_from_first() {
    motions_[0].joined = true;
    std::stable_sort(verdicts_.begin(), verdicts_.end(),
                     [](const JudgedPair& x, const JudgedPair& y) {
                       return x.verdict.best.agreement.score_m2 > y.verdict.best.agreement.score_m2;
                     });
    while (std::any_of(verdicts_.begin(), verdicts_.end(),
                       [&](const JudgedPair& judged) { return joins(judged); })) {
    }
    for (const JudgedPair& judged : verdicts_) {
      for (const std::size_t k : {judged.pair.a, judged.pair.b})
        if (!motions_[k].joined && motions_[k].reason.empty())
          motions_[k].reason = judged.verdict.reason;
    }
  }

  bool joins(const JudgedPair& judged) {
    PassMotion &a = motions_[judged.pair.a], &b = motions_[judged.pair.b];
    if (!judged.verdict.certain || a.joined == b.joined) return false;
    const Pose& T_a_b = judged.verdict.best.T_a_b;
    if (a.joined) {
      b.T_first_pass = a.T_first_pass * T_a_b;
    } else {
      a.T_first_pass = b.T_first_pass * T_a_b.inverse();
    }
    a.joined = b.joined = true;
    return true;
  }

  Result<> adjust_joined() {
    std::vector<std::size_t> number(motions_.size(), 0);
    std::vector<const PreparedPass*> joined;
    std::vector<Pose> start;
    for (std::size_t k = 0; k < motions_.size(); ++k) {
      if (!motions_[k].joined) continue;
      number[k] = joined.size();
      joined.push_back(prepared_[k].get());
      start.push_back(motions_[k].T_first_pass);
    }
    if (joined.size() < 2) return {};
    std::vector<PassPair> pairs;
    for (const JudgedPair& judged : verdicts_) {
      const auto [a, b] = judged.pair;
      if (motions_[a].joined && motions_[b].joined && overlap(a, b))
        pairs.push_back({number[a], number[b]});
    }
    TURNSCAN_ASSIGN(const Adjustment fine, adjust(joined, pairs, start, reach(), {}, context_));
    for (std::size_t k = 0; k < motions_.size(); ++k)
      if (motions_[k].joined) state(fine, number[k], k);
    context_.advance();
    return {};
  }

  double reach() const {
    double noise = 0.0;
    for (const auto& pass : prepared_) noise = std::max(noise, pass->surface->noise_m);
    return 2.0 * noise;
  }

  Agreement agreement(std::size_t a, std::size_t b) const {
    const Pose T = motions_[a].T_first_pass.inverse() * motions_[b].T_first_pass;
    return compare(*prepared_[a], *prepared_[b], T,
                   agreement_tolerance_m(*prepared_[a], *prepared_[b]), Density::kMedium);
  }
  bool overlap(std::size_t a, std::size_t b) const {
    const double smaller = std::min(prepared_[a]->area_m2, prepared_[b]->area_m2);
    return agreement(a, b).agreeing_m2 > 0.25 * options_.min_overlap * smaller;
  }

  void state(const Adjustment& fine, std::size_t number, std::size_t k) {
    PassMotion& motion = motions_[k];
    motion.T_first_pass = fine.T_first_pass[number];
    motion.covariance = fine.covariances[number];
    motion.center = fine.center;
    motion.residual_m = fine.sigma_m;
    motion.sigma_rad = std::sqrt(motion.covariance.topLeftCorner<3, 3>().trace());
    motion.sigma_m =
        surface_sigma(*prepared_[k], motion.T_first_pass, fine.center, motion.covariance);
    for (std::size_t other = 0; other < motions_.size(); ++other) {
      if (other == k || !motions_[other].joined) continue;
      const Agreement with = agreement(std::min(k, other), std::max(k, other));
      motion.overlap_m2 = std::max(motion.overlap_m2, with.agreeing_m2);
      motion.against_m2 = std::max(motion.against_m2, with.against_m2);
    }
  }

  const JoinOptions& options_;
  const RunContext& context_;
  std::vector<std::unique_ptr<PreparedPass>> prepared_;
  std::vector<JudgedPair> verdicts_;
  std::vector<PassMotion> motions_;
};

}  // namespace

Result<std::vector<PassMotion>> join_passes(std::span<const PassSurface> passes,
                                            const JoinOptions& options, const RunContext& context) {
  TURNSCAN_TRY(check_passes(passes));
  return PassJoin(options, context).run(passes);
}

}  // namespace turnscan::passes
