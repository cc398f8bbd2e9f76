#include <turnscan/reconstruction/passes/pair_verdict.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <turnscan/reconstruction/passes/undetermined.hpp>

namespace turnscan::passes {

namespace {

/// Number of candidates that are refined before they are compared, and the effort.
constexpr std::size_t kAdjusted = 4, kAdjustedByColors = 8;
constexpr AdjustEffort kTrial{4000, 10};

/// Ratio of the evidence of a second motion above which the first one is ambiguous; above the lower
/// ratio it is, unless the difference is significant. For objects that are alike from both sides
/// the ratios were above 0.99, and the preferences below 4.
constexpr double kGuess = 0.975, kMaybe = 0.9, kSure = 5.0;

/// An object that is alike from several sides may overlap most in a wrong pose: a motion with half
/// the agreement, as close, and as little contradiction, is a rival. For a knot with sixfold
/// symmetry the other five had more than 0.8, up to 1.3, and nothing; the next best 0.35, 6, and
/// contradicted more than it agreed.
constexpr double kHalf = 0.5, kAsClosely = 1.5, kHardly = 0.003;

bool fits_as_closely(const Agreement& best, const Agreement& other) {
  return other.agreeing_m2 > kHalf * best.agreeing_m2 && other.rms_m < kAsClosely * best.rms_m &&
         other.against_m2 * best.agreeing_m2 <
             (best.against_m2 + kHardly * best.agreeing_m2) * other.agreeing_m2;
}

bool rivals(const PreparedPass& a, const PreparedPass& b, const CandidateMotion& best,
            const CandidateMotion& other) {
  const double share = other.agreement.score_m2 / best.agreement.score_m2;
  return share > kGuess || fits_as_closely(best.agreement, other.agreement) ||
         (share > kMaybe &&
          preference(a, b, best.T_a_b, other.T_a_b, agreement_tolerance_m(a, b)) < kSure);
}

/// Share of the differences of colour that a motion has to explain; for a ball with a few patches
/// wrong motions explained up to 0.65. And ratios to the evidence of the best motion above which
/// another one is a rival, or may be if the difference is not significant.
constexpr double kColorsFit = 0.7, kExplainsAsMuch = 0.9, kExplainsSome = 0.4;
/// If colours are used, a rival may have more agreement elsewhere, but not a closer one.
constexpr double kLoose = 1.3;
/// Colours attract only within a few millimetres: candidates that stopped short of the best one,
/// within this share of the object's size, are not different.
constexpr double kStoppedShort = 0.1;

/// The fraction `share` of a rigid motion, as a screw.
Pose part_of(const Pose& motion, double share) {
  const Eigen::AngleAxisd turn(motion.linear());
  const Vec3d t = motion.translation(), along = turn.axis().dot(t) * turn.axis();
  // The axis passes through the point that the rotation alone would move by the rest of t.
  const Vec3d across = t - along;
  const Vec3d point = 0.5 * (across + turn.axis().cross(across) / std::tan(0.5 * turn.angle()));
  Pose part = Pose::Identity();
  part.linear() = Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
  part.translation() = point - part.linear() * point + share * along;
  return part;
}

constexpr double kOnTheWay = 0.75;  // relative to the score, since intermediate motions are not
                                    // refined

/// Describes the alternative motions: any rotation about an axis, or a single one.
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

/// Judges a pair by its shapes or, if the scale has a spread, also by colours.
class Judge {
 public:
  Judge(const PreparedPass& a, const PreparedPass& b, const ColorScale& colors,
        const JoinOptions& options, const RunContext& context)
      : a_(a),
        b_(b),
        colors_(colors),
        options_(options),
        context_(context),
        tolerance_m_(agreement_tolerance_m(a, b)) {}

  Result<PairVerdict> run() {
    TURNSCAN_TRY(adjust_candidates());
    PairVerdict out;
    if (adjusted_.empty()) {
      out.reason = "their surfaces coincide nowhere";
      return out;
    }
    out.best = adjusted_[0].first;
    out.adjustment = std::move(adjusted_[0].second);
    out.reason = misfit(a_, b_, out.best.agreement, options_);
    out.fits = out.reason.empty();
    if (out.fits) out.reason = open(out);
    out.certain = out.reason.empty();
    out.by_colors = out.certain && colors_.any();
    return out;
  }

 private:
  /// Refines the best motions; best first.
  Result<> adjust_candidates() {
    TURNSCAN_ASSIGN(const auto motions, search_motions(a_, b_, colors_, context_));
    const std::array<const PreparedPass*, 2> both{&a_, &b_};
    const PassPair pair{0, 1, colors_.any()};
    for (std::size_t i = 0;
         i < std::min(colors_.any() ? kAdjustedByColors : kAdjusted, motions.size()); ++i) {
      auto fine = adjust(both, std::span(&pair, 1), {Pose::Identity(), motions[i].T_a_b},
                         2.0 * tolerance_m_, kTrial, context_);
      TURNSCAN_TRY(context_.check());
      if (!fine) continue;
      CandidateMotion motion{fine->T_first_pass[1], {}, {}};
      motion.agreement = compare(a_, b_, motion.T_a_b, tolerance_m_, Density::kMedium);
      if (colors_.any())
        motion.colors =
            compare_colors(a_, b_, motion.T_a_b, colors_, tolerance_m_, Density::kMedium);
      adjusted_.emplace_back(motion, std::move(*fine));
    }
    std::stable_sort(adjusted_.begin(), adjusted_.end(), [](const auto& x, const auto& y) {
      return x.first.evidence_m2() > y.first.evidence_m2();
    });
    return {};
  }

  /// A motion that hides the patterns in the other pass's unobserved surface explains nothing.
  bool rivals_in_color(const CandidateMotion& best, const CandidateMotion& other) const {
    const double share = other.colors.evidence_m2() / best.colors.evidence_m2();
    return share > kExplainsAsMuch ||
           (share > kExplainsSome &&
            color_preference(a_, b_, best.T_a_b, other.T_a_b, colors_, tolerance_m_) < kSure);
  }

  /// Why the motion is ambiguous although it fits; empty if it is not.
  std::string open(const PairVerdict& verdict) const {
    const CandidateMotion& best = verdict.best;
    if (colors_.any() && best.colors.explained() < kColorsFit)
      return "their colours coincide nowhere";
    const double same_m =
        colors_.any() ? kStoppedShort * std::max(a_.extent_m, b_.extent_m) : same_motion_m(a_, b_);
    for (std::size_t i = 1; i < adjusted_.size(); ++i) {
      const CandidateMotion& other = adjusted_[i].first;
      if (motion_distance(b_, best.T_a_b, other.T_a_b) < same_m) continue;
      if (colors_.any() && best.agreement.rms_m > kLoose * other.agreement.rms_m)
        return "where their colours fit their shapes do not";
      if (!rivals(a_, b_, best, other)) continue;
      if (colors_.any() && !rivals_in_color(best, other)) continue;
      return (colors_.any() ? "" : "its shape does not determine how it lay: ") +
             rival_text(a_, b_, best, other);
    }
    return undetermined_direction(b_, verdict.adjustment, options_.max_sigma_m);
  }

  const PreparedPass& a_;
  const PreparedPass& b_;
  const ColorScale& colors_;
  const JoinOptions& options_;
  const RunContext& context_;
  double tolerance_m_;
  std::vector<std::pair<CandidateMotion, Adjustment>> adjusted_;
};

}  // namespace

std::string misfit(const PreparedPass& a, const PreparedPass& b, const Agreement& agreement,
                   const JoinOptions& options) {
  const double smaller = std::min(a.area_m2, b.area_m2);
  if (agreement.agreeing_m2 < options.min_overlap * smaller)
    return fmt::format(
        "their surfaces overlap too little, by {:.1f} of {:.1f} cm^2, to tell the motion",
        agreement.agreeing_m2 * 1e4, smaller * 1e4);
  if (agreement.against_m2 > options.max_against * agreement.agreeing_m2)
    return fmt::format(
        "they contradict each other: where {:.1f} cm^2 fit best, {:.1f} cm^2 of what one measured "
        "lies where the other saw nothing; these are different objects, or it changed its shape",
        agreement.agreeing_m2 * 1e4, agreement.against_m2 * 1e4);
  return {};
}

Result<PairVerdict> judge_shapes(const PreparedPass& a, const PreparedPass& b,
                                 const JoinOptions& options, const RunContext& context) {
  return Judge(a, b, {}, options, context).run();
}

Result<PairVerdict> judge_colors(PairVerdict by_shape, const PreparedPass& a, const PreparedPass& b,
                                 const JoinOptions& options, const RunContext& context) {
  if (by_shape.certain || !by_shape.fits) return by_shape;
  const ColorScale colors = color_scale(a, b);
  if (!colors.any()) return by_shape;
  TURNSCAN_ASSIGN(PairVerdict by_colors, Judge(a, b, colors, options, context).run());
  if (by_colors.certain) return by_colors;
  by_shape.reason += "; by its colours: " + by_colors.reason;
  return by_shape;
}

}  // namespace turnscan::passes
