#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <turnscan/reconstruction/passes/join_passes.hpp>
#include <turnscan/reconstruction/passes/object_groups.hpp>
#include <turnscan/reconstruction/passes/object_match.hpp>
#include <turnscan/reconstruction/passes/undetermined.hpp>

namespace turnscan::passes {

namespace {

Result<> check_passes(std::span<const std::vector<PassSurface>> passes) {
  if (passes.size() < 2)
    return fail(ErrorCode::kTooFewPoints, "join passes: there are {}, two are needed",
                passes.size());
  for (std::size_t k = 0; k < passes.size(); ++k)
    for (const PassSurface& surface : passes[k])
      if (auto good = check_surface(surface); !good)
        return fail(good.error().code, "join passes: pass {}: {}", k, good.error().message);
  return {};
}

class ObjectJoin {
 public:
  ObjectJoin(const JoinOptions& options, const RunContext& context)
      : options_(options), context_(context) {}

  Result<std::vector<std::vector<ObjectPart>>> run(std::span<const std::vector<PassSurface>> passes,
                                                   const AddColors& add_colors) {
    TURNSCAN_ASSIGN(auto out, join(passes));
    const bool open =
        std::any_of(out.begin(), out.end(), [](const auto& parts) { return parts[0].motion.open; });
    if (!open || !add_colors) return out;
    TURNSCAN_ASSIGN(const bool colored, add_colors());
    return colored ? join(passes) : std::move(out);
  }

 private:
  Result<std::vector<std::vector<ObjectPart>>> join(
      std::span<const std::vector<PassSurface>> passes) {
    prepare(passes);
    context_.begin_phase("join passes", pairs_of_objects() + 1);
    // Neighbours first: they overlap most, and imply where the others lie.
    for (std::size_t apart = 1; apart < passes.size(); ++apart)
      for (std::size_t a = 0; a + apart < passes.size(); ++a)
        TURNSCAN_TRY(judge_passes(a, a + apart));
    TURNSCAN_ASSIGN(const std::vector<ObjectGroup> groups,
                    group_objects(objects_, verdicts_, options_, context_));
    std::vector<std::vector<ObjectPart>> out;
    for (const ObjectGroup& group : groups) {
      TURNSCAN_ASSIGN(std::vector<ObjectPart> parts, parts_of(group));
      out.push_back(std::move(parts));
    }
    std::stable_sort(out.begin(), out.end(), [](const auto& x, const auto& y) {
      return std::pair(x[0].pass, x[0].object) < std::pair(y[0].pass, y[0].object);
    });
    context_.advance();
    return out;
  }

  void prepare(std::span<const std::vector<PassSurface>> passes) {
    prepared_.clear();
    objects_.clear();
    first_of_pass_.clear();
    verdicts_.clear();
    chains_.clear();
    for (std::size_t pass = 0; pass < passes.size(); ++pass) {
      first_of_pass_.push_back(objects_.size());
      for (std::size_t object = 0; object < passes[pass].size(); ++object) {
        prepared_.push_back(std::make_unique<PreparedPass>(passes[pass][object]));
        chains_.push_back({objects_.size(), Pose::Identity()});
        objects_.push_back({pass, object, prepared_.back().get()});
      }
    }
    first_of_pass_.push_back(objects_.size());
  }

  std::size_t pairs_of_objects() const {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < objects_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) pairs += objects_[i].pass != objects_[j].pass ? 1 : 0;
    return pairs;
  }

  Result<> judge_passes(std::size_t a, std::size_t b) {
    std::vector<const PreparedPass*> of_a, of_b;
    for (std::size_t i = first_of_pass_[a]; i < first_of_pass_[a + 1]; ++i)
      of_a.push_back(objects_[i].surface);
    for (std::size_t j = first_of_pass_[b]; j < first_of_pass_[b + 1]; ++j)
      of_b.push_back(objects_[j].surface);
    const bool single = of_a.size() == 1 && of_b.size() == 1;
    if (single && is_implied(first_of_pass_[a], first_of_pass_[b])) {
      context_.advance();
      return {};
    }
    VerdictTable table(of_a.size());
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      for (std::size_t j = 0; j < of_b.size(); ++j) {
        TURNSCAN_ASSIGN(PairVerdict verdict, judge(first_of_pass_[a] + i, first_of_pass_[b] + j));
        table[i].push_back(std::move(verdict));
        context_.advance();
      }
    }
    if (!single) match_objects(of_a, of_b, table);
    for (std::size_t i = 0; i < of_a.size(); ++i)
      for (std::size_t j = 0; j < of_b.size(); ++j)
        verdicts_.push_back({first_of_pass_[a] + i, first_of_pass_[b] + j, std::move(table[i][j])});
    // Surfaces that colours had to tell apart agree in other poses, too: they confirm nothing.
    if (single && verdicts_.back().verdict.certain && !verdicts_.back().verdict.by_colors)
      chain(verdicts_.back());
    return {};
  }

  /// What the shapes say is asked only once.
  Result<PairVerdict> judge(std::size_t a, std::size_t b) {
    const PreparedPass &of_a = *objects_[a].surface, &of_b = *objects_[b].surface;
    auto known = by_shape_.find({a, b});
    if (known == by_shape_.end()) {
      TURNSCAN_ASSIGN(PairVerdict verdict, judge_shapes(of_a, of_b, options_, context_));
      known = by_shape_.emplace(std::pair(a, b), std::move(verdict)).first;
    }
    return judge_colors(known->second, of_a, of_b, options_, context_);
  }

  void chain(const JudgedPair& certain) {
    const Chain to = chains_[certain.a], from = chains_[certain.b];
    if (to.first == from.first) return;
    const Pose T = to.T_first_object * certain.verdict.best.T_a_b * from.T_first_object.inverse();
    for (Chain& chain : chains_)
      if (chain.first == from.first) chain = {to.first, T * chain.T_first_object};
  }

  /// Whether certain pairs already place one relative to the other, their surfaces agree there, and
  /// neither contradicts it: judging them costs as much as any pair, and would say the same.
  bool is_implied(std::size_t a, std::size_t b) const {
    if (chains_[a].first != chains_[b].first) return false;
    const PreparedPass &of_a = *objects_[a].surface, &of_b = *objects_[b].surface;
    const Agreement there =
        compare(of_a, of_b, chains_[a].T_first_object.inverse() * chains_[b].T_first_object,
                agreement_tolerance_m(of_a, of_b), Density::kMedium);
    return misfit(of_a, of_b, there, options_).empty();
  }

  Result<std::vector<ObjectPart>> parts_of(const ObjectGroup& group) const {
    std::vector<ObjectPart> out;
    for (std::size_t i = 0; i < group.members.size(); ++i) {
      const TableObject& object = objects_[group.members[i]];
      ObjectPart& part = out.emplace_back(ObjectPart{object.pass, object.object, {}});
      part.motion.T_first_pass = group.T_here_member[i];
      part.motion.joined = group.members.size() > 1;
    }
    if (out.size() == 1) {
      out[0].motion.reason = "no other pass has an object";
      if (const PairVerdict* verdict = verdict_of(group.members[0])) {
        out[0].motion.reason = verdict->reason;
        out[0].motion.open = verdict->fits;
      }
    } else {
      TURNSCAN_TRY(adjust_parts(group, out));
    }
    return out;
  }

  /// The pair with the most evidence among the rejected ones.
  const PairVerdict* verdict_of(std::size_t object) const {
    for (const JudgedPair& judged : verdicts_)
      if ((judged.a == object || judged.b == object) && !judged.verdict.reason.empty())
        return &judged.verdict;
    return nullptr;
  }

  Result<> adjust_parts(const ObjectGroup& group, std::vector<ObjectPart>& parts) const {
    std::vector<const PreparedPass*> surfaces;
    std::vector<Pose> start;
    double noise = 0.0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      surfaces.push_back(objects_[group.members[i]].surface);
      start.push_back(parts[i].motion.T_first_pass);
      noise = std::max(noise, surfaces.back()->surface->noise_m);
    }
    std::vector<PassPair> pairs = overlapping(surfaces, start);
    for (PassPair& pair : pairs)
      pair.by_colors = told_by_colors(group.members[pair.a], group.members[pair.b]);
    TURNSCAN_ASSIGN(const Adjustment fine,
                    adjust(surfaces, pairs, start, 2.0 * noise, {}, context_));
    for (std::size_t i = 0; i < parts.size(); ++i) state(surfaces, fine, i, parts[i].motion);
    for (const PassPair& pair : pairs) parts[pair.b].motion.by_colors |= pair.by_colors;
    for (const JudgedPair& judged : verdicts_) {
      if (!judged.verdict.certain || !judged.verdict.interchangeable) continue;
      for (std::size_t i = 0; i < parts.size(); ++i)
        parts[i].motion.interchangeable |= group.members[i] == judged.b;
    }
    return {};
  }

  bool told_by_colors(std::size_t a, std::size_t b) const {
    return std::any_of(verdicts_.begin(), verdicts_.end(), [&](const JudgedPair& judged) {
      return judged.a == a && judged.b == b && judged.verdict.certain && judged.verdict.by_colors;
    });
  }

  static Agreement agreement(std::span<const PreparedPass* const> surfaces,
                             const std::vector<Pose>& poses, std::size_t a, std::size_t b) {
    return compare(*surfaces[a], *surfaces[b], poses[a].inverse() * poses[b],
                   agreement_tolerance_m(*surfaces[a], *surfaces[b]), Density::kMedium);
  }

  /// The pairs with significant overlap, and for each part the one with which it overlaps most.
  std::vector<PassPair> overlapping(std::span<const PreparedPass* const> surfaces,
                                    const std::vector<Pose>& poses) const {
    const std::size_t n = surfaces.size();
    std::vector<std::vector<double>> share(n, std::vector<double>(n, 0.0));
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = a + 1; b < n; ++b)
        share[a][b] = share[b][a] = agreement(surfaces, poses, a, b).agreeing_m2 /
                                    std::min(surfaces[a]->area_m2, surfaces[b]->area_m2);
    }
    const auto most = [&](std::size_t a) {
      return std::size_t(std::max_element(share[a].begin(), share[a].end()) - share[a].begin());
    };
    std::vector<PassPair> out;
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        if (share[a][b] > 0.25 * options_.min_overlap || most(a) == b || most(b) == a)
          out.push_back({a, b});
    return out;
  }

  static void state(std::span<const PreparedPass* const> surfaces, const Adjustment& fine,
                    std::size_t i, PassMotion& motion) {
    motion.T_first_pass = fine.T_first_pass[i];
    motion.covariance = fine.covariances[i];
    motion.center = fine.center;
    motion.residual_m = fine.sigma_m;
    motion.sigma_rad = std::sqrt(motion.covariance.topLeftCorner<3, 3>().trace());
    motion.sigma_m =
        surface_sigma(*surfaces[i], motion.T_first_pass, fine.center, motion.covariance);
    for (std::size_t other = 0; other < surfaces.size(); ++other) {
      if (other == i) continue;
      const Agreement with =
          agreement(surfaces, fine.T_first_pass, std::min(i, other), std::max(i, other));
      motion.overlap_m2 = std::max(motion.overlap_m2, with.agreeing_m2);
      motion.against_m2 = std::max(motion.against_m2, with.against_m2);
    }
  }

  /// A chain of certain pairs that leads to an object.
  struct Chain {
    std::size_t first;  ///< object; the same for all that are connected
    Pose T_first_object;
  };

  const JoinOptions& options_;
  const RunContext& context_;
  std::map<std::pair<std::size_t, std::size_t>, PairVerdict> by_shape_;
  std::vector<Chain> chains_;  // by object
  std::vector<std::unique_ptr<PreparedPass>> prepared_;
  std::vector<TableObject> objects_;        // pass by pass
  std::vector<std::size_t> first_of_pass_;  // position in objects_; one more at the end
  std::vector<JudgedPair> verdicts_;
};

}  // namespace

Result<std::vector<std::vector<ObjectPart>>> join_objects(
    std::span<const std::vector<PassSurface>> passes, const JoinOptions& options,
    const RunContext& context, const AddColors& add_colors) {
  TURNSCAN_TRY(check_passes(passes));
  return ObjectJoin(options, context).run(passes, add_colors);
}

Result<std::vector<PassMotion>> join_passes(std::span<const PassSurface> passes,
                                            const JoinOptions& options, const RunContext& context) {
  std::vector<std::vector<PassSurface>> tables;
  for (const PassSurface& pass : passes) tables.emplace_back(1, pass);
  TURNSCAN_ASSIGN(auto objects, join_objects(tables, options, context));
  std::vector<PassMotion> out(passes.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (ObjectPart& part : objects[i]) {
      PassMotion& motion = out[part.pass] = std::move(part.motion);
      if (i == 0) continue;
      if (motion.joined) motion.reason = "it fits other passes, but none that fits the first";
      motion.joined = false;
    }
  }
  out[0].joined = true;
  out[0].reason.clear();
  return out;
}

}  // namespace turnscan::passes
