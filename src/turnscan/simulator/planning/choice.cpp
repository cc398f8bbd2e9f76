#include <algorithm>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <turnscan/core/parallel.hpp>
#include <turnscan/simulator/planning/choice.hpp>

namespace turnscan::planning {

namespace {

using Set = std::vector<std::uint32_t>;

/// The best worth of a set's candidates at each point.
std::vector<std::uint16_t> best_of(const WorthTable& table, const Set& set) {
  std::vector<std::uint16_t> best(table.points, 0);
  for (const std::uint32_t c : set) {
    const std::uint16_t* row = table.row(c);
    for (std::size_t i = 0; i < best.size(); ++i) best[i] = std::max(best[i], row[i]);
  }
  return best;
}

std::uint64_t sum_of(const std::vector<std::uint16_t>& worth) {
  return std::accumulate(worth.begin(), worth.end(), std::uint64_t(0));
}

std::uint64_t gain_of(const std::vector<std::uint16_t>& best, const std::uint16_t* row) {
  std::uint64_t gain = 0;
  for (std::size_t i = 0; i < best.size(); ++i)
    gain += std::uint64_t(row[i] > best[i] ? row[i] - best[i] : 0);
  return gain;
}

std::size_t candidates_of(const std::vector<ChoiceGroup>& groups) {
  std::size_t n = 0;
  bool first = true;
  for (const ChoiceGroup& group : groups) {
    if (group.alternatives.empty())
      throw std::invalid_argument("choose: a group without alternatives");
    for (const WorthTable& table : group.alternatives) {
      if (table.points == 0 || table.worth.size() % table.points != 0 ||
          table.points != group.alternatives.front().points || (!first && table.candidates() != n))
        throw std::invalid_argument("choose: tables of different sizes");
      n = table.candidates();
      first = false;
    }
  }
  return n;
}

/// Upper bound for extensions of a set.
struct Outlook {
  std::uint64_t bound = 0;
  Set order;  ///< allowed candidates, those with the largest gains first
};

/// allowed: candidates that may be added, at most `more` of them.
Outlook outlook(const std::vector<ChoiceGroup>& groups, const Set& set, const Set& allowed,
                std::size_t more) {
  Outlook out;
  std::vector<std::uint64_t> most_gain(allowed.size(), 0);
  for (const ChoiceGroup& group : groups) {
    std::uint64_t most = 0;
    std::vector<std::uint64_t> best_here(allowed.size(), 0);
    for (const WorthTable& table : group.alternatives) {
      const auto best = best_of(table, set);
      std::vector<std::uint64_t> gains(allowed.size());
      parallel_for(allowed.size(), 16,
                   [&](std::size_t i) { gains[i] = gain_of(best, table.row(allowed[i])); });
      for (std::size_t i = 0; i < gains.size(); ++i)
        best_here[i] = std::max(best_here[i], gains[i] + sum_of(best));
      const std::size_t taken = std::min(more, gains.size());
      std::partial_sort(gains.begin(), gains.begin() + std::ptrdiff_t(taken), gains.end(),
                        std::greater<>());
      most = std::max(most, std::accumulate(gains.begin(), gains.begin() + std::ptrdiff_t(taken),
                                            sum_of(best)));
    }
    out.bound += group.weight * most;
    for (std::size_t i = 0; i < allowed.size(); ++i) most_gain[i] += group.weight * best_here[i];
  }
  std::vector<std::uint32_t> places(allowed.size());
  std::iota(places.begin(), places.end(), 0u);
  std::stable_sort(places.begin(), places.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return most_gain[a] > most_gain[b]; });
  for (const std::uint32_t i : places) out.order.push_back(allowed[i]);
  return out;
}

/// Whether b is worth at least as much as a everywhere, and more somewhere or is earlier.
bool dominates(const std::vector<ChoiceGroup>& groups, std::uint32_t b, std::uint32_t a) {
  bool more = b < a;
  for (const ChoiceGroup& group : groups) {
    for (const WorthTable& table : group.alternatives) {
      const std::uint16_t *rb = table.row(b), *ra = table.row(a);
      for (std::size_t i = 0; i < table.points; ++i) {
        if (rb[i] < ra[i]) return false;
        more = more || rb[i] > ra[i];
      }
    }
  }
  return more;
}

/// Candidates that no other dominates: the best set consists of some of them.
Set undominated(const std::vector<ChoiceGroup>& groups, std::size_t n) {
  std::vector<std::uint8_t> kept(n, 1);
  parallel_for(n, 1, [&](std::size_t a) {
    for (std::uint32_t b = 0; b < n && kept[a]; ++b)
      if (b != a && dominates(groups, b, std::uint32_t(a))) kept[a] = 0;
  });
  Set out;
  for (std::uint32_t c = 0; c < n; ++c)
    if (kept[c]) out.push_back(c);
  return out;
}

class Chooser {
 public:
  Chooser(const std::vector<ChoiceGroup>& groups, const ChoiceOptions& options)
      : groups_(groups),
        options_(options),
        allowed_(undominated(groups, candidates_of(groups))),
        n_(allowed_.size()) {}

  Result<Choice> run(const RunContext& context) {
    TURNSCAN_TRY(greedy(context));
    TURNSCAN_TRY(exchange(context));
    TURNSCAN_TRY(branch(context));
    drop_idle();
    std::sort(out_.candidates.begin(), out_.candidates.end());
    value_of(groups_, out_.candidates, &out_.alternatives);
    return out_;
  }

 private:
  std::uint64_t value(const Set& set) {
    ++out_.evaluations;
    return value_of(groups_, set);
  }

  /// Gains of earlier rounds are upper bounds of later ones only with a single alternative each;
  /// with several, the maximum over them need not be submodular, and all are evaluated again.
  Result<> greedy(const RunContext& context) {
    const bool lazy = std::all_of(groups_.begin(), groups_.end(), [](const ChoiceGroup& group) {
      return group.alternatives.size() == 1;
    });
    std::vector<std::uint64_t> gain(n_, ~std::uint64_t(0));  // indexed as allowed_
    while (out_.candidates.size() < std::min(options_.most, n_)) {
      TURNSCAN_TRY(context.check());
      std::vector<std::uint32_t> order(n_);
      std::iota(order.begin(), order.end(), 0u);
      std::stable_sort(order.begin(), order.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return gain[a] > gain[b]; });
      std::uint64_t best = 0;
      std::uint32_t chosen = 0;
      for (const std::uint32_t c : order) {
        if (lazy && gain[c] < best) break;
        Set with = out_.candidates;
        with.push_back(allowed_[c]);
        gain[c] = value(with) - out_.value;
        if (gain[c] > best || (gain[c] == best && best > 0 && c < chosen))
          best = gain[c], chosen = c;
      }
      if (best == 0) break;
      out_.candidates.push_back(allowed_[chosen]);
      out_.value += best;
    }
    return {};
  }

  /// Exchanges one candidate for another as long as that increases the value.
  Result<> exchange(const RunContext& context) {
    for (bool better = true; better;) {
      better = false;
      for (std::size_t k = 0; k < out_.candidates.size(); ++k) {
        TURNSCAN_TRY(context.check());
        std::vector<std::uint64_t> values(n_);
        parallel_for(n_, 4, [&](std::size_t c) {
          Set with = out_.candidates;
          with[k] = allowed_[c];
          values[c] = value_of(groups_, with);
        });
        out_.evaluations += n_;
        const auto best = std::max_element(values.begin(), values.end());
        if (*best <= out_.value) continue;
        out_.candidates[k] = allowed_[std::size_t(best - values.begin())];
        out_.value = *best;
        better = true;
      }
    }
    return {};
  }

  /// Removes candidates that add nothing to the others.
  void drop_idle() {
    for (std::size_t k = out_.candidates.size(); k-- > 0;) {
      Set without = out_.candidates;
      without.erase(without.begin() + std::ptrdiff_t(k));
      if (value(without) == out_.value) out_.candidates = std::move(without);
    }
  }

  /// A set, and the candidates that may still be added.
  struct Node {
    std::uint64_t bound = 0;
    std::uint64_t number = 0;  ///< order of creation
    Set set, allowed;
    bool operator<(const Node& o) const {
      return bound != o.bound ? bound < o.bound : number > o.number;
    }
  };

  Result<> branch(const RunContext& context) {
    std::priority_queue<Node> open;
    std::uint64_t made = 0;
    open.push({~std::uint64_t(0), made++, {}, allowed_});
    for (std::uint64_t nodes = 0; !open.empty() && open.top().bound > out_.value; ++nodes) {
      TURNSCAN_TRY(context.check());
      if (nodes >= options_.most_nodes && nodes > 0) break;
      const Node node = open.top();
      open.pop();
      const std::size_t more = options_.most - node.set.size();
      const Outlook look = outlook(groups_, node.set, node.allowed, more);
      out_.evaluations += node.allowed.size();
      const std::uint64_t bound = std::min(look.bound, node.bound);
      if (bound <= out_.value) continue;
      if (more == 1) {
        take(node.set, look.order.front());
        continue;
      }
      // Branches: with the first of the order, or without it.
      Set rest(look.order.begin() + 1, look.order.end());
      Set with = node.set;
      with.push_back(look.order.front());
      take(node.set, look.order.front());
      if (rest.empty()) continue;
      open.push({bound, made++, std::move(with), rest});
      open.push({bound, made++, node.set, std::move(rest)});
    }
    out_.bound = open.empty() ? out_.value : std::max(out_.value, open.top().bound);
    return {};
  }

  void take(Set set, std::uint32_t candidate) {
    set.push_back(candidate);
    const std::uint64_t worth = value(set);
    if (worth <= out_.value) return;
    out_.value = worth;
    out_.candidates = std::move(set);
  }

  const std::vector<ChoiceGroup>& groups_;
  const ChoiceOptions& options_;
  Set allowed_;
  std::size_t n_;
  Choice out_;
};

}  // namespace

std::uint64_t value_of(const std::vector<ChoiceGroup>& groups, const Set& candidates,
                       std::vector<std::uint32_t>* alternatives) {
  if (alternatives != nullptr) alternatives->clear();
  std::uint64_t sum = 0;
  for (const ChoiceGroup& group : groups) {
    std::uint64_t most = 0;
    std::uint32_t which = 0;
    for (std::uint32_t a = 0; a < group.alternatives.size(); ++a) {
      const std::uint64_t worth = sum_of(best_of(group.alternatives[a], candidates));
      if (worth > most) most = worth, which = a;
    }
    sum += group.weight * most;
    if (alternatives != nullptr) alternatives->push_back(which);
  }
  return sum;
}

Result<Choice> choose(const std::vector<ChoiceGroup>& groups, const ChoiceOptions& options,
                      const RunContext& context) {
  if (options.most == 0) throw std::invalid_argument("choose: nothing is to be chosen");
  TURNSCAN_TRY(context.check());
  return Chooser(groups, options).run(context);
}

}  // namespace turnscan::planning
