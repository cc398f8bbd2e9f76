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
  CandidateMotion best;
  Adjustment adjustment;  ///< of the best; empty where nothing fits
};

/// Fails with kCancelled.
Result<PairVerdict> judge_pair(const PreparedPass& a, const PreparedPass& b,
                               const JoinOptions& options, const RunContext& context);

}  // namespace turnscan::passes
