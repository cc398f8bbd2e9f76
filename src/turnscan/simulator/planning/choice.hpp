#pragma once
// Selects the few of many candidates that show most, with an upper bound for any other choice.

#include <cstdint>
#include <optional>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::planning {

/// The worth of each candidate at each of n points, as integers, so that sums do not depend on the
/// order. One row per candidate.
struct WorthTable {
  std::size_t points = 0;
  std::vector<std::uint16_t> worth;  ///< candidates x points

  std::size_t candidates() const { return points == 0 ? 0 : worth.size() / points; }
  const std::uint16_t* row(std::size_t candidate) const {
    return worth.data() + candidate * points;
  }
};

/// An object that the candidates look at, in one of several alternatives (the sets of poses in
/// which it is placed); the best alternative counts. Alternatives have the same candidates and
/// points.
struct ChoiceGroup {
  std::uint64_t weight = 1;  ///< of each point
  std::vector<WorthTable> alternatives;
};

struct Choice {
  std::vector<std::uint32_t> candidates;    ///< ascending; fewer than requested if more add nothing
  std::vector<std::uint32_t> alternatives;  ///< per group
  std::uint64_t value = 0;
  /// Upper bound of any choice with as many candidates; equal to value if the choice is proven
  /// optimal.
  std::uint64_t bound = 0;
  std::uint64_t evaluations = 0;  ///< number of sets whose value was computed
};

struct ChoiceOptions {
  std::size_t most = 1;             ///< maximum number of chosen candidates
  std::uint64_t most_nodes = 2000;  ///< of the branch and bound, over all groups' alternatives
};

/// The value of a set S of candidates is sum over groups of weight * max over alternatives of sum
/// over points of max over S of the worth: for one alternative a facility location function,
/// monotone and submodular.
///
/// Greedy selection with lazy evaluation (Minoux 1978, Accelerated greedy algorithms for maximizing
/// submodular set functions) achieves at least 1 - 1/e of the optimum (Nemhauser, Wolsey, Fisher
/// 1978, An analysis of approximations for maximizing submodular set functions I) for a single
/// alternative; exchanges of one candidate then improve it; a best-first branch and bound proves
/// its optimality or finds a better one. Its bound for the extension of a set is the submodular one
/// of Nemhauser and Wolsey: the value plus the largest remaining gains. If it is ended by
/// most_nodes, `bound` is the largest of the remaining ones. Candidates that are dominated by
/// another everywhere are removed first. Among equals the first in order is taken. Deterministic.
/// Fails with kCancelled; throws std::invalid_argument if tables do not match.
Result<Choice> choose(const std::vector<ChoiceGroup>& groups, const ChoiceOptions& options,
                      const RunContext& context);

/// The value of a set, and the alternative that achieves it for each group.
std::uint64_t value_of(const std::vector<ChoiceGroup>& groups,
                       const std::vector<std::uint32_t>& candidates,
                       std::vector<std::uint32_t>* alternatives = nullptr);

}  // namespace turnscan::planning
