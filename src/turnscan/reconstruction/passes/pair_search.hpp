#pragma once
// Searches for the motions between two passes that the evidence allows, best first.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/color_match.hpp>

namespace turnscan::passes {

struct CandidateMotion {
  Pose T_a_b = Pose::Identity();
  Agreement agreement;
  ColorAgreement colors;  ///< if colours are used

  /// Ranking criterion. If colours are used, the shapes fit in many ways, and their overlap is
  /// hardly informative.
  double evidence_m2() const {
    constexpr double kOfShape = 0.1;
    return colors.area_m2 > 0.0 ? colors.evidence_m2() + kOfShape * agreement.score_m2
                                : agreement.score_m2;
  }
};

/// Up to a dozen clearly different motions, refined on thinned surfaces; with colours twice as
/// many. colors: if its spread is 0, only shapes are used. Fails with kCancelled.
Result<std::vector<CandidateMotion>> search_motions(const PreparedPass& a, const PreparedPass& b,
                                                    const ColorScale& colors,
                                                    const RunContext& context);

/// Motions that move b's surface by less than this relative to each other are the same.
double same_motion_m(const PreparedPass& a, const PreparedPass& b);
/// Distance up to which refined surfaces agree.
double agreement_tolerance_m(const PreparedPass& a, const PreparedPass& b);

}  // namespace turnscan::passes
