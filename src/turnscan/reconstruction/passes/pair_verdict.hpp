#pragma once
// Which of the motions between two passes is the true one, if the evidence tells.

#include <turnscan/reconstruction/passes/joint_adjustment.hpp>
#include <turnscan/reconstruction/passes/pair_search.hpp>

namespace turnscan::passes {

struct PairVerdict {
  bool certain = false;
  std::string reason;            ///< why it is not
  bool fits = false;             ///< enough agrees and little contradicts, whatever the motion
  bool interchangeable = false;  ///< see match_objects()
  bool by_colors = false;        ///< the shape left it open, and the colours told
  CandidateMotion best;
  Adjustment adjustment;  ///< of the best; empty where nothing fits
};

/// Why two passes cannot be one object where they agree so; one clause, empty where they can.
std::string misfit(const PreparedPass& a, const PreparedPass& b, const Agreement& agreement,
                   const JoinOptions& options);

/// By their shapes; where these fit and leave the motion open, by their colours, if both have any.
/// Fails with kCancelled.
Result<PairVerdict> judge_pair(const PreparedPass& a, const PreparedPass& b,
                               const JoinOptions& options, const RunContext& context);

}  // namespace turnscan::passes
