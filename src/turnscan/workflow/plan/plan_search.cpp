#include <algorithm>
#include <cmath>
#include <limits>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/workflow/plan/plan_search.hpp>

namespace turnscan::workflow {

namespace {

constexpr double kErrorScale_m = 1e-3;
// Share of a spot's value that does not depend on its error.
constexpr double kCoveredShare = 0.997, kErrorShare = 0.5;
constexpr int kRefineRounds = 3;
constexpr double kSameShare = 5e-4, kSameError = 0.02;

/// Subsets of {1, ..., n - 1} with k members, each preceded by 0, in lexicographic order.
std::vector<std::vector<std::uint32_t>> subsets(std::size_t n, std::size_t k) {
  std::vector<std::vector<std::uint32_t>> out;
  std::vector<std::uint32_t> set{0};
  const auto extend = [&](const auto& self, std::uint32_t from) -> void {
    if (set.size() == k + 1) return out.push_back(set);
    for (std::uint32_t i = from; i < n; ++i) {
      set.push_back(i);
      self(self, i + 1);
      set.pop_back();
    }
  };
  extend(extend, 1);
  return out;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::uint16_t worth_of(double error_m, const std::optional<double>& max_error_m, Prefer prefer,
                       double chance) {
  if (max_error_m && error_m > *max_error_m) return 0;
  const double sure = prefer == Prefer::kCovered ? kCoveredShare : kErrorShare;
  const double good = 1.0 / (1.0 + error_m / kErrorScale_m);
  return static_cast<std::uint16_t>(
      std::lround(chance * kFullWorth * (sure + (1.0 - sure) * good)));
}

bool beats(const ChosenRig& a, const ChosenRig& b) {
  const auto costs = [](const ChosenRig& r) {
    return std::array<double, 2>{double(r.rig.places.size()), double(r.passes)};
  };
  const auto ca = costs(a), cb = costs(b);
  if (ca[0] > cb[0] || ca[1] > cb[1]) return false;
  const bool covers = a.score.covered >= b.score.covered - kSameShare;
  const bool errs = a.score.median_error_m <= b.score.median_error_m * (1.0 + kSameError);
  if (!covers || !errs) return false;
  return ca != cb || a.score.covered > b.score.covered + kSameShare ||
         a.score.median_error_m < b.score.median_error_m * (1.0 - kSameError);
}

std::vector<ChosenRig> unbeaten(const std::vector<ChosenRig>& rigs) {
  const auto alike = [](const ChosenRig& a, const ChosenRig& b) {
    return a.rig.places.size() == b.rig.places.size() && a.passes == b.passes &&
           std::abs(a.score.covered - b.score.covered) <= kSameShare &&
           std::abs(a.score.median_error_m - b.score.median_error_m) <=
               kSameError * b.score.median_error_m;
  };
  std::vector<ChosenRig> kept;
  for (const ChosenRig& rig : rigs) {
    const bool beaten =
        std::any_of(rigs.begin(), rigs.end(), [&](const auto& other) { return beats(other, rig); });
    const bool known =
        std::any_of(kept.begin(), kept.end(), [&](const auto& other) { return alike(other, rig); });
    if (!beaten && !known) kept.push_back(rig);
  }
  std::stable_sort(kept.begin(), kept.end(), [](const ChosenRig& a, const ChosenRig& b) {
    return a.score.covered > b.score.covered;
  });
  return kept;
}

std::size_t PlanSearch::most_passes() const {
  const PlanOptions& o = request_.options;
  std::size_t most = std::size_t(o.passes);
  if (o.time_budget_s) {
    const double further = (*o.time_budget_s - o.turn_time_s) / (o.turn_time_s + o.change_time_s);
    most = std::min(most, 1 + std::size_t(std::max(0.0, std::floor(further + 1e-9))));
  }
  for (const PlanObject& object : field_.objects) most = std::min(most, object.poses.size());
  return most;
}

Result<> PlanSearch::look(const RunContext& context) {
  struct Task {
    std::size_t object, pose, place;
  };
  std::vector<Task> tasks;
  looks_.resize(field_.objects.size());
  for (std::size_t m = 0; m < field_.objects.size(); ++m) {
    const PlanObject& object = field_.objects[m];
    const std::size_t n = field_.places.size() * object.surface.spots.size();
    looks_[m].assign(object.poses.size(), std::vector<Look>(n));
    for (std::size_t q = 0; q < object.poses.size(); ++q)
      for (std::size_t c = 0; c < field_.places.size(); ++c) tasks.push_back({m, q, c});
  }
  context.begin_phase("candidates", tasks.size());
  parallel_for(tasks.size(), 1, [&](std::size_t i) {
    if (context.cancelled()) return;
    const auto [m, q, c] = tasks[i];
    const PlanObject& object = field_.objects[m];
    const auto sights = sights_from(field_, object, object.poses[q], field_.places[c]);
    Look* row = looks_[m][q].data() + c * sights.size();
    for (std::size_t s = 0; s < sights.size(); ++s)
      if (sights[s].chance() > 0.0f)
        row[s] = {float(model_.at(object.surface.spots[s], sights[s])), sights[s].chance()};
    context.advance();
  });
  turns_ += tasks.size();
  return context.check();
}

std::vector<planning::ChoiceGroup> PlanSearch::groups(
    std::size_t passes, Prefer prefer,
    std::vector<std::vector<std::vector<std::uint32_t>>>& poses) const {
  std::vector<planning::ChoiceGroup> out;
  poses.clear();
  for (std::size_t m = 0; m < field_.objects.size(); ++m) {
    const PlanObject& object = field_.objects[m];
    const std::size_t spots = object.surface.spots.size();
    planning::ChoiceGroup& group = out.emplace_back();
    // In square millimetres per spot, so that objects are weighted by their area.
    group.weight =
        std::uint64_t(std::max(1.0, std::round(1e8 * object.surface.area_m2 / double(spots))));
    poses.push_back(subsets(object.poses.size(), passes - 1));
    for (const auto& set : poses.back()) {
      planning::WorthTable table;
      table.points = spots;
      table.worth.assign(field_.places.size() * spots, 0);
      for (const std::uint32_t q : set)
        for (std::size_t i = 0; i < table.worth.size(); ++i)
          if (const Look& look = looks_[m][q][i]; look.chance > 0.0f)
            table.worth[i] = std::max(
                table.worth[i], worth_of(double(look.error_m), request_.options.max_error_m, prefer,
                                         double(look.chance)));
      group.alternatives.push_back(std::move(table));
    }
  }
  return out;
}

Result<ChosenRig> PlanSearch::choose_one(std::size_t sensors, std::size_t passes, Prefer prefer,
                                         const RunContext& context) {
  std::vector<std::vector<std::vector<std::uint32_t>>> poses;
  const auto worth = groups(passes, prefer, poses);
  planning::ChoiceOptions options;
  options.most = sensors;
  TURNSCAN_ASSIGN(const planning::Choice choice, planning::choose(worth, options, context));
  sets_ += choice.evaluations;
  ChosenRig out;
  for (const std::uint32_t c : choice.candidates) {
    PlanPlace& place = out.rig.places.emplace_back(field_.places[c]);
    // Sensors are placed side by side, not opposite each other; over a full turn the azimuth makes
    // no difference.
    place.placement.azimuth_rad =
        kTurn * double(out.rig.places.size() - 1) / double(choice.candidates.size() + 1);
  }
  for (std::size_t m = 0; m < poses.size(); ++m)
    out.rig.poses.push_back(poses[m][choice.alternatives[m]]);
  out.passes = passes;
  out.error_first = prefer == Prefer::kError;
  out.score = score(out.rig, prefer);
  double full = 0.0;
  for (const planning::ChoiceGroup& group : worth)
    full += double(group.weight) * double(group.alternatives.front().points) * kFullWorth;
  // Each covered spot has at least the guaranteed share of its value.
  const double sure = prefer == Prefer::kCovered ? kCoveredShare : kErrorShare;
  out.most_covered = std::min(1.0, double(choice.bound) / (full * sure));
  return out;
}

Result<std::vector<ChosenRig>> PlanSearch::choose_all(const RunContext& context) {
  const std::size_t passes = most_passes(), sensors = std::size_t(request_.options.sensors);
  std::vector<ChosenRig> all;
  context.begin_phase("choose", 2 * passes * sensors);
  for (std::size_t p = 1; p <= passes; ++p) {
    for (std::size_t s = 1; s <= sensors; ++s) {
      for (const Prefer prefer : {Prefer::kCovered, Prefer::kError}) {
        TURNSCAN_ASSIGN(ChosenRig rig, choose_one(s, p, prefer, context));
        // If fewer sensors suffice, that rig is already in the list.
        if (rig.rig.places.size() == s) all.push_back(std::move(rig));
        context.advance();
      }
    }
  }
  if (all.empty())
    return fail(ErrorCode::kInvalidOption,
                "plan: nothing is seen well enough from any placement that was tried; widen the "
                "ranges of distance and elevation, or the error");
  // An upper bound of the area holds for all rigs of the same size, whatever their preference.
  for (ChosenRig& rig : all)
    for (const ChosenRig& other : all)
      if (!other.error_first && other.passes == rig.passes &&
          other.rig.places.size() == rig.rig.places.size())
        rig.most_covered = std::min(rig.most_covered, other.most_covered);
  return unbeaten(all);
}

RigScore PlanSearch::score(const Rig& rig, Prefer prefer) {
  RigScore out;
  double area = 0.0;
  std::vector<double> errors;
  for (std::size_t m = 0; m < field_.objects.size(); ++m) {
    const PlanObject& object = field_.objects[m];
    const std::size_t spots = object.surface.spots.size();
    std::vector<planning::SpotSight> all(spots);
    std::vector<std::uint16_t> worth(spots, 0);
    std::vector<double> missed(spots, 1.0);  // probability that all of them miss it
    std::vector<std::vector<planning::SpotSight>> views(rig.places.size() * rig.poses[m].size());
    parallel_for(views.size(), 1, [&](std::size_t i) {
      const PlanPose& pose = object.poses[rig.poses[m][i % rig.poses[m].size()]];
      views[i] = sights_from(field_, object, pose, rig.places[i / rig.poses[m].size()]);
    });
    turns_ += views.size();
    for (const auto& view : views) {
      for (std::size_t s = 0; s < spots; ++s) {
        const double chance = double(view[s].chance());
        if (!(chance > 0.0)) continue;
        const double error = model_.at(object.surface.spots[s], view[s]);
        const auto here = worth_of(error, request_.options.max_error_m, prefer, chance);
        if (here == 0) continue;
        all[s] += view[s];
        missed[s] *= 1.0 - chance;
        worth[s] = std::max(worth[s], here);
      }
    }
    const double each = object.surface.area_m2 / double(spots);
    area += object.surface.area_m2;
    for (std::size_t s = 0; s < spots; ++s) {
      if (worth[s] == 0) continue;
      out.covered += each * (1.0 - missed[s]);
      out.value += each * double(worth[s]) / kFullWorth;
      if (all[s].seen()) errors.push_back(model_.at(object.surface.spots[s], all[s]));
    }
  }
  out.covered /= area;
  out.value /= area;
  out.median_error_m = median_of(std::move(errors));
  return out;
}

Result<ChosenRig> PlanSearch::refined(ChosenRig chosen, const RunContext& context) {
  const PlanOptions& o = request_.options;
  const Prefer prefer = chosen.error_first ? Prefer::kError : Prefer::kCovered;
  double distance_m = 0.5 * field_.distance_step_m, elevation_rad = 0.5 * field_.elevation_step_rad;
  double aim_m = 0.1 * field_.objects.front().height_m;
  for (int round = 0; round < kRefineRounds; ++round) {
    for (std::size_t k = 0; k < chosen.rig.places.size(); ++k) {
      const ScannerModel& model = field_.scanners[chosen.rig.places[k].scanner].model;
      TURNSCAN_ASSIGN(const DistanceRange range, distances_of(request_, field_, model));
      for (int move = 0; move < 6; ++move) {
        TURNSCAN_TRY(context.check());
        const double sign = move % 2 == 0 ? 1.0 : -1.0;
        Rig trial = chosen.rig;
        ScannerPlacement& at = trial.places[k].placement;
        if (move < 2)
          at.distance_m =
              std::clamp(at.distance_m + sign * distance_m, range.least_m, range.greatest_m);
        else if (move < 4)
          at.elevation_rad = std::clamp(at.elevation_rad + sign * elevation_rad,
                                        o.lowest_elevation_rad, o.highest_elevation_rad);
        else
          at.aim_height_m = std::max(0.0, *at.aim_height_m + sign * aim_m);
        const RigScore score = this->score(trial, prefer);
        if (score.value > chosen.score.value) chosen.rig = trial, chosen.score = score;
      }
    }
    distance_m *= 0.5, elevation_rad *= 0.5, aim_m *= 0.5;
  }
  return chosen;
}

}  // namespace turnscan::workflow
