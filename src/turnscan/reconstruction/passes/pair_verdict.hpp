#pragma once
// Decides which of the motions between two passes is the true one, if the evidence suffices.

#include <turnscan/reconstruction/passes/joint_adjustment.hpp>
#include <turnscan/reconstruction/passes/pair_search.hpp>

namespace turnscan::passes {

struct PairVerdict {
  bool certain = false;
  std::string reason;  ///< why it is not certain
  bool fits = false;   ///< enough surface agrees and little contradicts, whatever the motion
  bool interchangeable = false;  ///< see match_objects()
  bool by_colors = false;        ///< the shape left it undetermined, and the colours determined it
  CandidateMotion best;
  Adjustment adjustment;  ///< of the best; empty if nothing fits
};

/// Why two passes with this agreement cannot be one object; one clause, empty if they can.
std::string misfit(const PreparedPass& a, const PreparedPass& b, const Agreement& agreement,
                   const JoinOptions& options);

/// Decides by shapes. Fails with kCancelled.
Result<PairVerdict> judge_shapes(const PreparedPass& a, const PreparedPass& b,
                                 const JoinOptions& options, const RunContext& context);

/// If the shapes fit but leave the motion undetermined, decides by colours, if both have any. Fails
/// with kCancelled.
Result<PairVerdict> judge_colors(PairVerdict by_shape, const PreparedPass& a, const PreparedPass& b,
                                 const JoinOptions& options, const RunContext& context);

}  // namespace turnscan::passes
