#include <algorithm>
#include <turnscan/reconstruction/passes/merged_pass.hpp>
#include <turnscan/reconstruction/passes/object_groups.hpp>

namespace turnscan::passes {

namespace {

/// Maximum distance of two certain motions of one pair that count as the same, relative to that of
/// different candidates.
constexpr double kSameMotions = 2.0;

bool any_same_pass(std::span<const TableObject> objects, const ObjectGroup& one,
                   const ObjectGroup& other) {
  return std::any_of(one.members.begin(), one.members.end(), [&](std::size_t m) {
    return std::any_of(other.members.begin(), other.members.end(),
                       [&](std::size_t n) { return objects[m].pass == objects[n].pass; });
  });
}

class Grouping {
 public:
  Grouping(std::span<const TableObject> objects, std::vector<JudgedPair>& verdicts,
           const JoinOptions& options, const RunContext& context)
      : objects_(objects), verdicts_(verdicts), options_(options), context_(context) {
    for (std::size_t k = 0; k < objects.size(); ++k) {
      groups_.push_back({{k}, {Pose::Identity()}});
      group_of_.push_back(k);
    }
  }

  Result<std::vector<ObjectGroup>> run() {
    for (std::size_t v = 0; v < verdicts_.size(); ++v) unite(v);
    while (true) {
      TURNSCAN_ASSIGN(const bool more, unite_whole_groups());
      if (!more) break;
    }
    for (const std::size_t v : contradicted_) {
      verdicts_[v].verdict.certain = false;
      verdicts_[v].verdict.reason = "where it fits one pass best it contradicts others";
    }
    std::vector<ObjectGroup> out;
    for (ObjectGroup& group : groups_)
      if (!group.members.empty()) out.push_back(sorted(group));
    return out;
  }

 private:
  const PreparedPass& surface(std::size_t k) const { return *objects_[k].surface; }

  /// Contradicted verdicts stay certain until the end, since they also speak against the others.
  void unite(std::size_t v) {
    const JudgedPair& judged = verdicts_[v];
    const std::size_t one = group_of_[judged.a], other = group_of_[judged.b];
    if (!judged.verdict.certain || one == other) return;
    const Pose T_one_other =
        place(judged.a) * judged.verdict.best.T_a_b * place(judged.b).inverse();
    if (any_same_pass(objects_, groups_[one], groups_[other]) ||
        contradicts(groups_[one], groups_[other], T_one_other)) {
      contradicted_.push_back(v);
      return;
    }
    merge(one, other, T_one_other);
  }

  /// Pose in its group.
  const Pose& place(std::size_t k) const {
    const ObjectGroup& group = groups_[group_of_[k]];
    const auto at = std::find(group.members.begin(), group.members.end(), k);
    return group.T_here_member[std::size_t(at - group.members.begin())];
  }

  /// Whether the free space of one contradicts the poses of others, or other certain verdicts do.
  bool contradicts(const ObjectGroup& one, const ObjectGroup& other,
                   const Pose& T_one_other) const {
    double agreeing_m2 = 0.0, against_m2 = 0.0;
    for (std::size_t i = 0; i < one.members.size(); ++i) {
      for (std::size_t j = 0; j < other.members.size(); ++j) {
        const std::size_t a = std::min(one.members[i], other.members[j]);
        const std::size_t b = std::max(one.members[i], other.members[j]);
        const Pose T_i_j = one.T_here_member[i].inverse() * T_one_other * other.T_here_member[j];
        const Pose T_a_b = a == one.members[i] ? T_i_j : T_i_j.inverse();
        const Agreement both =
            compare(surface(a), surface(b), T_a_b, agreement_tolerance_m(surface(a), surface(b)),
                    Density::kMedium);
        agreeing_m2 += both.agreeing_m2;
        against_m2 += both.against_m2;
        if (another_is_sure(a, b, T_a_b)) return true;
      }
    }
    return against_m2 > options_.max_against * agreeing_m2;
  }

  bool another_is_sure(std::size_t a, std::size_t b, const Pose& T_a_b) const {
    return std::any_of(verdicts_.begin(), verdicts_.end(), [&](const JudgedPair& judged) {
      return judged.a == a && judged.b == b && judged.verdict.certain &&
             motion_distance(surface(b), T_a_b, judged.verdict.best.T_a_b) >
                 kSameMotions * same_motion_m(surface(a), surface(b));
    });
  }

  /// The other one becomes empty.
  void merge(std::size_t one, std::size_t other, const Pose& T_one_other) {
    ObjectGroup &into = groups_[one], &from = groups_[other];
    for (std::size_t j = 0; j < from.members.size(); ++j) {
      into.members.push_back(from.members[j]);
      into.T_here_member.push_back(T_one_other * from.T_here_member[j]);
      group_of_[from.members[j]] = one;
    }
    from = {};
  }

  MergedPass united(const ObjectGroup& group) const {
    std::vector<const PreparedPass*> surfaces;
    for (const std::size_t k : group.members) surfaces.push_back(objects_[k].surface);
    return {surfaces, group.T_here_member};
  }

  /// Merges the most certain pair of groups of which one has several members, if there is any.
  Result<bool> unite_whole_groups() {
    std::optional<PairVerdict> best;
    std::size_t into = 0, from = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      if (groups_[i].members.size() < 2) continue;
      const MergedPass whole = united(groups_[i]);
      for (std::size_t j = 0; j < groups_.size(); ++j) {
        const std::size_t count = groups_[j].members.size();
        if (i == j || count == 0 || (count > 1 && j < i) || refused(i, j)) continue;
        const MergedPass part = united(groups_[j]);
        TURNSCAN_ASSIGN(PairVerdict verdict,
                        judge_shapes(whole.prepared(), part.prepared(), options_, context_));
        if (!verdict.certain || contradicts(groups_[i], groups_[j], verdict.best.T_a_b)) {
          refuse(i, j);
        } else if (!best || verdict.best.agreement.score_m2 > best->best.agreement.score_m2) {
          best = std::move(verdict);
          into = i;
          from = j;
        }
      }
    }
    if (best) merge(into, from, best->best.T_a_b);
    return best.has_value();
  }

  /// Whether the pair was rejected with the same members, and need not be tested again.
  bool refused(std::size_t i, std::size_t j) const {
    return any_same_pass(objects_, groups_[i], groups_[j]) ||
           std::any_of(refused_.begin(), refused_.end(), [&](const auto& pair) {
             return pair.first == groups_[i].members && pair.second == groups_[j].members;
           });
  }
  void refuse(std::size_t i, std::size_t j) {
    refused_.emplace_back(groups_[i].members, groups_[j].members);
  }

  static ObjectGroup sorted(const ObjectGroup& group) {
    std::vector<std::size_t> order(group.members.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t x, std::size_t y) { return group.members[x] < group.members[y]; });
    ObjectGroup out;
    for (const std::size_t i : order) {
      out.members.push_back(group.members[i]);
      out.T_here_member.push_back(group.T_here_member[order[0]].inverse() * group.T_here_member[i]);
    }
    return out;
  }

  std::span<const TableObject> objects_;
  std::vector<JudgedPair>& verdicts_;
  const JoinOptions& options_;
  const RunContext& context_;
  std::vector<ObjectGroup> groups_;
  std::vector<std::size_t> group_of_;
  std::vector<std::size_t> contradicted_;  ///< verdicts
  std::vector<std::pair<std::vector<std::size_t>, std::vector<std::size_t>>> refused_;
};

}  // namespace

Result<std::vector<ObjectGroup>> group_objects(std::span<const TableObject> objects,
                                               std::vector<JudgedPair>& verdicts,
                                               const JoinOptions& options,
                                               const RunContext& context) {
  std::stable_sort(verdicts.begin(), verdicts.end(), [](const JudgedPair& x, const JudgedPair& y) {
    return x.verdict.best.agreement.score_m2 > y.verdict.best.agreement.score_m2;
  });
  return Grouping(objects, verdicts, options, context).run();
}

}  // namespace turnscan::passes
