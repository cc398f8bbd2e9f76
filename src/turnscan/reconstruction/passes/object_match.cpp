#include <turnscan/reconstruction/passes/agreement.hpp>
#include <turnscan/reconstruction/passes/object_assignment.hpp>
#include <turnscan/reconstruction/passes/object_match.hpp>

namespace turnscan::passes {

namespace {

/// A pair is ambiguous if an assignment without it lacks less than this share of its evidence.
constexpr double kClear = 0.1;
/// Of two objects of the same shape hardly anything of one is in the other's free space, and they
/// agree in this share of the measured surface of the smaller one.
constexpr double kSameAgainst = 0.02, kSameAgreeing = 0.25;

bool same_shape(const PreparedPass& one, const PreparedPass& other, const Pose& T_one_other) {
  const Agreement both =
      compare(one, other, T_one_other, agreement_tolerance_m(one, other), Density::kMedium);
  return both.agreeing_m2 > kSameAgreeing * std::min(one.area_m2, other.area_m2) &&
         both.against_m2 < kSameAgainst * both.agreeing_m2;
}

class ObjectMatch {
 public:
  ObjectMatch(std::span<const PreparedPass* const> a, std::span<const PreparedPass* const> b,
              VerdictTable& verdicts)
      : a_(a), b_(b), verdicts_(verdicts) {
    for (const auto& row : verdicts) {
      auto& out = evidence_.emplace_back();
      for (const PairVerdict& verdict : row)
        out.push_back(verdict.fits ? verdict.best.agreement.score_m2 : 0.0);
    }
    best_ = assign_objects(evidence_);
  }

  void run() {
    for (std::size_t r = 0; r < a_.size(); ++r) {
      for (std::size_t c = 0; c < b_.size(); ++c) {
        if (best_.column_of[r] == c)
          question(r, c);
        else if (verdicts_[r][c].fits)
          turn_down(verdicts_[r][c], "another of the objects fits better");
      }
    }
  }

 private:
  static void turn_down(PairVerdict& verdict, std::string reason) {
    verdict.certain = false;
    verdict.reason = std::move(reason);
  }

  const Pose& motion(std::size_t r, std::size_t c) const { return verdicts_[r][c].best.T_a_b; }

  /// Tests whether the pair is needed for the evidence, and marks it if not.
  void question(std::size_t r, std::size_t c) {
    EvidenceTable without = evidence_;
    without[r][c] = 0.0;
    const Assignment other = assign_objects(without);
    if (best_.evidence - other.evidence > kClear * evidence_[r][c]) return;
    bool same = true;
    if (const auto c2 = other.column_of[r])
      same &= same_shape(*b_[c], *b_[*c2], motion(r, c).inverse() * motion(r, *c2));
    for (std::size_t r2 = 0; r2 < a_.size(); ++r2)
      if (other.column_of[r2] == c)
        same &= same_shape(*a_[r], *a_[r2], motion(r, c) * motion(r2, c).inverse());
    if (same)
      verdicts_[r][c].interchangeable = true;
    else
      turn_down(verdicts_[r][c],
                "two of the objects fit it alike, though they differ from each other");
  }

  std::span<const PreparedPass*const> a_, b_;
  VerdictTable& verdicts_;
  EvidenceTable evidence_;
  Assignment best_;
};

}  // namespace

void match_objects(std::span<const PreparedPass* const> a, std::span<const PreparedPass* const> b,
                   VerdictTable& verdicts) {
  ObjectMatch(a, b, verdicts).run();
}

}  // namespace turnscan::passes
