#include <turnscan/reconstruction/passes/pair_verdict.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/reconstruction/passes/undetermined.hpp>

namespace turnscan::passes {

namespace {

/// Candidates that are refined before they are compared, and how well.
constexpr std::size_t kAdjusted = 4;
constexpr AdjustEffort kTrial{4000, 10};

/// A second motion with so nearly the same evidence makes the first one a guess; the lower share
/// does unless the difference is sure. Of things that are alike from both sides the shares were
/// above 0.99, and the preferences below 4.
constexpr double kGuess = 0.975, kMaybe = 0.9, kSure = 5.0;

bool rivals(const PreparedPass& a, const PreparedPass& b, const CandidateMotion& best,
            const CandidateMotion& other) {
  const double share = other.agreement.score_m2 / best.agreement.score_m2;
  return share > kGuess || (share > kMaybe && preference(a, b, best.T_a_b, other.T_a_b,
                                                         agreement_tolerance_m(a, b)) < kSure);
}

/// The part `share` of the way of a rigid motion, as a screw.
Pose part_of(const Pose& motion, double share) {
  const Eigen::AngleAxisd turn(motion.linear());
  const Vec3d t = motion.translation(), along = turn.axis().dot(t) * turn.axis();
  // The axis goes through the point that the turn alone would move by what is left of t.
  const Vec3d across = t - along;
  const Vec3d point = 0.5 * (across + turn.axis().cross(across) / std::tan(0.5 * turn.angle()));
  Pose part = Pose::Identity();
  part.linear() = Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
  part.translation() = point - part.linear() * point + share * along;
  return part;
}

constexpr double kOnTheWay = 0.75;  // of the score, since there nothing was refined

/// How the object could lie as well: by any turn about an axis, or by one.
std::string rival_text(const PreparedPass& a, const PreparedPass& b, const CandidateMotion& best,
                       const CandidateMotion& other) {
  const Pose between = other.T_a_b * best.T_a_b.inverse();
  const Eigen::AngleAxisd turn(between.linear());
  bool any = true;
  for (const double share : {0.29, 0.43, 0.71}) {
    const Agreement there = compare(a, b, part_of(between, share) * best.T_a_b,
                                    agreement_tolerance_m(a, b), Density::kMedium);
    any &= there.score_m2 > kOnTheWay * best.agreement.score_m2;
  }
  const std::string about = fmt::format("about the axis ({:.2f}, {:.2f}, {:.2f}) of the first pass",
                                        turn.axis().x(), turn.axis().y(), turn.axis().z());
  return any ? fmt::format("any turn {} fits", about)
             : fmt::format("turned by {:.0f} deg {} it fits as well",
                           turn.angle() * 180.0 / std::numbers::pi, about);
}

}  // namespace

Result<PairVerdict> judge_pair(const PreparedPass& a, const PreparedPass& b,
                               const JoinOptions& options, const RunContext& context) {
  TURNSCAN_ASSIGN(std::vector<CandidateMotion> motions, search_motions(a, b, context));
  PairVerdict out;
  const std::array<const PreparedPass*, 2> both{&a, &b};
  const PassPair pair{0, 1};
  const double tolerance = agreement_tolerance_m(a, b);
  std::vector<std::pair<CandidateMotion, Adjustment>> adjusted;
  for (std::size_t i = 0; i < std::min(kAdjusted, motions.size()); ++i) {
    auto fine = adjust(both, std::span(&pair, 1), {Pose::Identity(), motions[i].T_a_b},
                       2.0 * tolerance, kTrial, context);
    TURNSCAN_TRY(context.check());
    if (!fine) continue;
    CandidateMotion motion{fine->T_first_pass[1], {}};
    motion.agreement = compare(a, b, motion.T_a_b, tolerance, Density::kMedium);
    adjusted.emplace_back(motion, std::move(*fine));
  }
  std::stable_sort(adjusted.begin(), adjusted.end(), [](const auto& x, const auto& y) {
    return x.first.agreement.score_m2 > y.first.agreement.score_m2;
  });
  if (adjusted.empty()) {
    out.reason = "nowhere do their surfaces lie on each other";
    return out;
  }
  out.best = adjusted[0].first;
  out.adjustment = std::move(adjusted[0].second);
  const Agreement& agreement = out.best.agreement;
  const double smaller = std::min(a.area_m2, b.area_m2);
  if (agreement.agreeing_m2 < options.min_overlap * smaller) {
    out.reason = fmt::format(
        "their surfaces overlap too little, by {:.1f} of {:.1f} cm^2, to tell the motion",
        agreement.agreeing_m2 * 1e4, smaller * 1e4);
    return out;
  }
  if (agreement.against_m2 > options.max_against * agreement.agreeing_m2) {
    out.reason = fmt::format(
        "they contradict each other: where {:.1f} cm^2 fit best, {:.1f} cm^2 of what one measured "
        "lies where the other saw nothing; these are different objects, or it changed its shape",
        agreement.agreeing_m2 * 1e4, agreement.against_m2 * 1e4);
    return out;
  }
  out.fits = true;
  for (std::size_t i = 1; i < adjusted.size(); ++i) {
    const CandidateMotion& other = adjusted[i].first;
    if (motion_distance(b, out.best.T_a_b, other.T_a_b) < same_motion_m(a, b)) continue;
    if (!rivals(a, b, out.best, other)) continue;
    out.reason = "its shape does not tell how it lay: " + rival_text(a, b, out.best, other);
    return out;
  }
  out.reason = undetermined_direction(b, out.adjustment, options.max_sigma_m);
  out.certain = out.reason.empty();
  return out;
}

}  // namespace turnscan::passes
