#pragma once
// Which few of many candidates show most, and how much more any others could show at most.

#include <cstdint>
#include <optional>
#include <turnscan/core/run_context.hpp>
#include <vector>

namespace turnscan::planning {

/// What each candidate is worth at each of n points, as whole numbers, so that sums are the same in
/// any order. A row a candidate.
struct WorthTable {
  std::size_t points = 0;
  std::vector<std::uint16_t> worth;  ///< candidates x points

  std::size_t candidates() const { return points == 0 ? 0 : worth.size() / points; }
  const std::uint16_t* row(std::size_t candidate) const {
    return worth.data() + candidate * points;
  }
};

/// An object that the candidates look at, in one of several ways at a time (the sets of poses in
/// which it is laid); the best way counts. Alternatives have the same candidates, and points.
struct ChoiceGroup {
  std::uint64_t weight = 1;  ///< of each point
  std::vector<WorthTable> alternatives;
};

struct Choice {
  std::vector<std::uint32_t>
      candidates;  ///< ascending; fewer than asked for where more add nothing
  std::vector<std::uint32_t> alternatives;  ///< of each group
  std::uint64_t value = 0;
  /// No choice of as many is worth more; equal to value where the choice is proven the best.
  std::uint64_t bound = 0;
  std::uint64_t evaluations = 0;  ///< values of sets that were computed
};

struct ChoiceOptions {
  std::size_t most = 1;             ///< candidates that are chosen
  std::uint64_t most_nodes = 2000;  ///< of the branch and bound, all groups' alternatives together
};

/// The value of a set S of candidates is sum over groups of weight * max over alternatives of sum
/// over points of max over S of the worth: for one alternative a facility location function,
/// monotone and submodular.
///
/// Greedy with lazy evaluation (Minoux 1978, Accelerated greedy algorithms for maximizing
/// submodular set functions) gives at least 1 - 1/e of the best (Nemhauser, Wolsey, Fisher 1978, An
/// analysis of approximations for maximizing submodular set functions I) for a single alternative;
/// exchanges of one candidate then improve it; a best-first branch and bound proves it or finds
/// better. Its bound of what a set can still become is the submodular one of Nemhauser and Wolsey:
/// the value plus the largest gains that are left. Where it is ended by most_nodes, `bound` is the
/// largest of those left. Candidates that another is worth as much as everywhere are left out
/// first. Of equals the first in order is taken. Deterministic. Fails with kCancelled; throws
/// std::invalid_argument where tables do not fit together.
Result<Choice> choose(const std::vector<ChoiceGroup>& groups, const ChoiceOptions& options,
                      const RunContext& context);

/// The value of a set, and the alternative that gives it for each group.
std::uint64_t value_of(const std::vector<ChoiceGroup>& groups,
                       const std::vector<std::uint32_t>& candidates,
                       std::vector<std::uint32_t>* alternatives = nullptr);

}  // namespace turnscan::planning
