#pragma once
// The motions between two passes that the evidence allows, best first.

#include <turnscan/core/run_context.hpp>
#include <turnscan/reconstruction/passes/agreement.hpp>

namespace turnscan::passes {

struct CandidateMotion {
  Pose T_a_b = Pose::Identity();
  Agreement agreement;
};

/// Up to a dozen clearly different motions, refined on thinned surfaces. Fails with kCancelled.
Result<std::vector<CandidateMotion>> search_motions(const PreparedPass& a, const PreparedPass& b,
                                                    const RunContext& context);

/// Motions that move b's surface by less than this from each other are one.
double same_motion_m(const PreparedPass& a, const PreparedPass& b);
/// Distance up to which refined surfaces agree.
double agreement_tolerance_m(const PreparedPass& a, const PreparedPass& b);

}  // namespace turnscan::passes
