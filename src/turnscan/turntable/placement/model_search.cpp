#include <algorithm>
#include <cmath>
#include <map>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/placement/model_search.hpp>

namespace turnscan::placement {

namespace {

constexpr int kMaxRounds = 4;
/// Minimum chi square that a model must explain of the poses of unconstrained frames.
constexpr double kClearGain = 100.0, kGainPerUnknown = 6.0;
/// And of the residuals at the current poses: frames that overlap in little more than edges end up
/// anywhere. A step of 0.7 to 3 mm explains 130 or more, a spurious one in an undisturbed recording
/// up to 60.
constexpr double kClearGainHere = 40.0, kGainPerUnknownHere = 10.0;
/// A wobble recurs with every turn and is seen by all frames; because of its many unknowns it would
/// have to explain more than there is under a sensor's own errors. In undisturbed recordings
/// spurious wobbles explain up to 27 of unconstrained poses, and 19 at the current ones.
constexpr double kClearWobble = 60.0, kClearWobbleHere = 40.0;
/// A smaller tilt is indistinguishable from a translation that a sensor's errors may cause, and
/// must explain as much as other disturbances.
constexpr double kMinWobble_rad = 0.1 * kRadiansPerDegree;
/// Frames that see the same side see it at the same phase of a wobble, and the others share little:
/// their mismatch is not informative, but may not grow by more than this factor.
constexpr double kMaxMismatch = 1.02;
/// Nor by more than this if the platter's tilts alone explain as much as a clear disturbance.
constexpr double kClearTilts = 100.0, kMaxMismatchTilted = 1.1;
/// Minimum number of keyframes on either side of an event: a few wrong ones, due to shared errors,
/// are not an event.
constexpr std::size_t kMinBeside = 5;
/// Minimum displacement of the object's points.
constexpr double kMinSize_m = 0.0005;
/// Relative error of a speed beyond which it is corrected before anything else.
constexpr double kFarOff = 0.08;
/// Smaller errors of the calibration are not corrected: a sensor's warped depth looks like one.
constexpr double kMinCalibration_m = 0.0015;
/// Upper limit of wobbles: larger ones arise from weakly observed directions together with another
/// calibration.
constexpr double kLargestWobble_rad = 3.0 * kRadiansPerDegree;
constexpr PairWeighting kHere{0.015, 0.006, 2}, kFine{0.01, 0.003, 2};

using Penalty = double (*)(const DisturbanceModel& model, double lever_m);

/// Penalty for comparing disturbances.
double full_penalty_of(const DisturbanceModel& model, double = 0.0) {
  return kGainPerUnknown * double(unknowns_of(model.kind)) + kClearGain;
}

bool leans(const DisturbanceModel& model, double lever_m) {
  return model.kind == ModelKind::kWobble && wobble_rad(model, lever_m) > kMinWobble_rad;
}

/// Penalty for accepting a disturbance.
double penalty_of(const DisturbanceModel& model, double lever_m) {
  return leans(model, lever_m) ? kClearWobble : full_penalty_of(model);
}

double penalty_here(const DisturbanceModel& model, double lever_m) {
  return leans(model, lever_m)
             ? kClearWobbleHere
             : kGainPerUnknownHere * double(unknowns_of(model.kind)) + kClearGainHere;
}

DisturbanceModel model_of(ModelKind kind, std::size_t first = 0, std::size_t last = 0,
                          double cycles = 0.0) {
  return {kind, first, last, cycles, Eigen::VectorXd::Zero(unknowns_of(kind)), false};
}

bool turns(ModelKind kind) {
  return kind == ModelKind::kSpeed || kind == ModelKind::kSlip || kind == ModelKind::kHalt;
}

bool plausible(const DisturbanceModel& model, double lever_m) {
  if (model.kind != ModelKind::kWobble) return true;
  return wobble_rad(model, lever_m) < kLargestWobble_rad;
}

using Models = std::vector<DisturbanceModel>;

class ModelSearch {
 public:
  ModelSearch(const Keyframes& keyframes, const ModelFrames& frames, const RunContext& context)
      : keyframes_(keyframes), frames_(frames), context_(context) {}

  Result<Models> run(const PoseGraph& graph) {
    models_ = {model_of(ModelKind::kCalibration)};
    TURNSCAN_TRY(try_other_speed(graph));
    for (int k = 0; k < kMaxRounds; ++k) {
      TURNSCAN_TRY(context_.check());
      TURNSCAN_ASSIGN(const bool found, add_best(graph));
      if (!found) break;
    }
    if (models_.size() > 1) TURNSCAN_TRY(settle_calibration());
    return std::move(models_);
  }

 private:
  /// The keyframes with the current models applied.
  std::vector<ModelFrame> current() const {
    std::vector<ModelFrame> out;
    for (const std::size_t position : keyframes_.positions) {
      out.push_back(frames_.all[position]);
      out.back().T_table_sensor = placed(out.back(), models_, frames_.scene);
    }
    return out;
  }

  std::vector<Pose> poses() const {
    std::vector<Pose> out;
    for (const ModelFrame& frame : current()) out.push_back(frame.T_table_sensor);
    return out;
  }

  bool has(ModelKind kind) const {
    return std::any_of(models_.begin(), models_.end(),
                       [&](const DisturbanceModel& model) { return model.kind == kind; });
  }

  bool all_plausible() const {
    return std::all_of(models_.begin(), models_.end(), [&](const DisturbanceModel& model) {
      return plausible(model, frames_.scene.lever_m);
    });
  }

  Models candidates() const {
    Models out{model_of(ModelKind::kSpeed)};
    for (const double cycles : {1.0, 2.0, 3.0, 4.0})
      out.push_back(model_of(ModelKind::kWobble, 0, 0, cycles));
    const auto& at = keyframes_.positions;
    for (std::size_t k = kMinBeside; k + kMinBeside <= at.size(); ++k) {
      for (const ModelKind kind : {ModelKind::kSlip, ModelKind::kObject, ModelKind::kSensor})
        out.push_back(model_of(kind, at[k], at[k - 1]));
      for (const std::size_t lasts : {2, 3, 4, 6, 9, 14})
        if (k >= lasts) out.push_back(model_of(ModelKind::kHalt, at[k], at[k - lasts]));
    }
    return out;
  }

  /// For each kind of disturbance the candidate that explains most.
  Models best_of_kinds(const Evidence& evidence, const Models& models) const {
    const auto all = candidates();
    const auto gains = evidence.gains(models, all);
    std::map<ModelKind, std::pair<double, std::size_t>> best;
    for (std::size_t k = 0; k < all.size(); ++k) {
      auto& [gain, at] = best[all[k].kind];
      if (gains[k] > gain) gain = gains[k], at = k;
    }
    Models out;
    for (const auto& [kind, found] : best)
      if (found.first > 0.0) out.push_back(all[found.second]);
    return out;
  }

  /// Each alone, and a slip or a halt also together with another speed: a speed that was measured
  /// over the whole recording contains both.
  std::vector<Models> candidate_sets(const Evidence& evidence, const Models& models) const {
    std::vector<Models> out;
    for (DisturbanceModel& model : best_of_kinds(evidence, models)) out.push_back({model});
    if (has(ModelKind::kSpeed)) return out;
    auto with_speed = models;
    with_speed.push_back(model_of(ModelKind::kSpeed));
    for (DisturbanceModel& model : best_of_kinds(evidence, with_speed))
      if (turns(model.kind)) out.push_back({with_speed.back(), model});
    return out;
  }

  /// Significance with which the last models of a fit explain the residuals of one without them.
  double gain_over(const ModelFit& with, const ModelFit& without, Penalty penalty) const {
    double gain = (with.gain - without.gain) / with.spread + with.tilt_gain - without.tilt_gain;
    for (std::size_t k = without.models.size(); k < with.models.size(); ++k)
      gain -= penalty(with.models[k], frames_.scene.lever_m);
    return gain;
  }

  /// If a speed is far off, frames that are assumed to show the same view do not, and are
  /// misleading; the rotations of unconstrained frames from one to the next are not.
  Result<> try_other_speed(const PoseGraph& graph) {
    std::vector<double> faster;
    for (std::size_t k = 1; k < keyframes_.size(); ++k) {
      const double believed =
          turn_between(keyframes_.T_table_sensor[k], keyframes_.T_table_sensor[k - 1]);
      if (std::abs(believed) > 1e-3)
        faster.push_back(turn_between(graph.poses[k], graph.poses[k - 1]) / believed - 1.0);
    }
    const double most = faster.empty() ? 0.0 : median(faster);
    if (std::abs(most) < kFarOff) return {};
    DisturbanceModel model = model_of(ModelKind::kSpeed);
    std::vector<Models> starts;
    for (const double way : {-1.0, 1.0}) {
      model.values[0] = way * most * frames_.scene.turn_rad * frames_.scene.lever_m;
      starts.push_back({model});
    }
    TURNSCAN_TRY(keep_better(starts));
    return {};
  }

  /// Adds the disturbance that explains most, if any is clear, and refines all. Returns whether it
  /// did.
  Result<bool> add_best(const PoseGraph& graph) {
    const Evidence free(keyframes_, graph, poses(), current(), frames_.scene);
    const Evidence here = evidence_here(kHere, false);
    Models zeroed = models_;
    for (DisturbanceModel& model : zeroed) model.values.setZero();
    const ModelFit free_before = free.fit(zeroed), here_before = here.fit(zeroed);
    std::vector<Models> starts;
    double most = -kClearGain;
    for (const Models& set : candidate_sets(free, zeroed)) {
      auto models = zeroed;
      models.insert(models.end(), set.begin(), set.end());
      const ModelFit freely = free.fit(models), shown = here.fit(models);
      const double gain = gain_over(freely, free_before, full_penalty_of);
      if (!(gain > most) || freely.sizes_m.back() < kMinSize_m) continue;
      if (!(gain_over(freely, free_before, penalty_of) > 0.0)) continue;
      if (!(gain_over(shown, here_before, penalty_here) > 0.0)) continue;
      most = gain;
      const auto added = std::ptrdiff_t(set.size());
      starts = {Models(freely.models.end() - added, freely.models.end()),
                Models(shown.models.end() - added, shown.models.end())};
    }
    if (starts.empty()) return false;
    return keep_better(starts);
  }

  /// Refines all models from several starts of the new ones; keeps the best if it is better than
  /// without them: frames fit each other better, or, for a wobble, no worse, and it still explains
  /// clearly more.
  Result<bool> keep_better(const std::vector<Models>& starts) {
    const Models before = models_;
    const bool wobbles = starts.front().back().kind == ModelKind::kWobble;
    const double without = mismatch(keyframes_, poses());
    Models best;
    double least = wobbles ? 0.0 : without;
    for (const Models& start : starts) {
      models_ = before;
      models_.insert(models_.end(), start.begin(), start.end());
      TURNSCAN_TRY(refine());
      const double here = mismatch(keyframes_, poses());
      const RefinedGain gain = wobbles ? gain_when_refined(before.size()) : RefinedGain();
      const double cost = wobbles ? -gain.all : here;
      const double most = gain.tilts > kClearTilts ? kMaxMismatchTilted : kMaxMismatch;
      if (!(cost < least) || !all_plausible() || here > most * without) continue;
      least = cost;
      best = models_;
    }
    const bool better = !best.empty();
    models_ = better ? best : before;
    if (!better || models_.size() <= 2) return better;
    simplify();
    TURNSCAN_TRY(refine());
    return true;
  }

  struct RefinedGain {
    double all = 0.0;    ///< relative to the required chi square
    double tilts = 0.0;  ///< of the platter alone
  };

  /// Significance with which the models after the first ones explain the residuals of those, after
  /// refinement.
  RefinedGain gain_when_refined(std::size_t first) const {
    const Evidence evidence = evidence_here(kFine, true);
    const auto at = models_.begin() + std::ptrdiff_t(first);
    const ModelFit fewer = evidence.fit(Models(models_.begin(), at)), all = evidence.fit(models_);
    return {gain_over(all, fewer, penalty_here), all.tilt_gain - fewer.tilt_gain};
  }

  /// Drops models that the others make redundant; a slip then explains their part as well.
  void simplify() {
    const Evidence evidence = evidence_here(kFine, true);
    ModelFit best = evidence.fit(models_);
    const auto simpler = [&](Models models, double least) {
      ModelFit fit = evidence.fit(std::move(models));
      if (fit.gain + fit.spread * fit.tilt_gain < least) return false;
      best = std::move(fit);
      return true;
    };
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = 1; k < best.models.size() && !changed; ++k) {
        const ModelKind kind = best.models[k].kind;
        const double worth = best.spread * penalty_of(best.models[k], frames_.scene.lever_m);
        Models fewer = best.models;
        fewer.erase(fewer.begin() + std::ptrdiff_t(k));
        const double all = best.gain + best.spread * best.tilt_gain;
        changed = simpler(fewer, all - worth);
        if (changed || (kind != ModelKind::kObject && kind != ModelKind::kSensor)) continue;
        Models slip = best.models;
        slip[k] = model_of(ModelKind::kSlip, slip[k].first, slip[k].last);
        changed = simpler(slip, all - worth + best.spread * full_penalty_of(slip[k]));
      }
    }
    models_ = std::move(best.models);
  }

  /// Evidence at the poses of the models; whole: of everything that they explain rather than of the
  /// residuals.
  Evidence evidence_here(const PairWeighting& weighting, bool whole) const {
    PoseGraph graph;
    graph.poses = poses();
    const auto pairs = all_pairs(keyframes_, graph.poses);
    graph.constraints = constrain_all(keyframes_, graph.poses, pairs, weighting);
    graph.scale_m = std::max(scale_of(graph.constraints), 1e-6);
    return Evidence(keyframes_, graph, whole ? keyframes_.T_table_sensor : graph.poses, current(),
                    frames_.scene);
  }

  /// Gauss-Newton for the unknowns of all models, with new correspondences.
  Result<> refine() {
    PairWeighting weighting{0.015, 0.008, 2};
    for (int i = 0; i < 5; ++i) {
      TURNSCAN_TRY(context_.check());
      const Evidence evidence = evidence_here(weighting, false);
      const ModelFit step = evidence.fit(models_);
      for (std::size_t k = 0; k < models_.size(); ++k) models_[k].values += step.models[k].values;
      const double limit = std::max(1.5 * evidence.scale_m(), 0.2 * keyframes_.data.noise_m);
      weighting.huber_m = std::max(limit, 0.6 * weighting.huber_m);
      weighting.reach_m = std::max(0.75 * weighting.reach_m, 8.0 * limit);
    }
    return {};
  }

  Result<> settle_calibration() {
    Eigen::VectorXd& values = models_.front().values;
    if (values.norm() > kMinCalibration_m) return {};
    values.setZero();
    models_.front().held = true;
    return refine();
  }

  const Keyframes& keyframes_;
  const ModelFrames& frames_;
  const RunContext& context_;
  Models models_;
};

}  // namespace

ModelFrames model_frames(const std::vector<Pose>& believed, const Keyframes& keyframes) {
  ModelFrames out;
  double turned = 0.0;
  for (std::size_t i = 0; i < believed.size(); ++i) {
    if (i > 0) turned += turn_between(believed[i], believed[i - 1]);
    out.all.push_back({i, turned, believed[i]});
  }
  out.scene.middle = keyframes.middle;
  out.scene.middle_sensor = keyframes.data.middle;
  out.scene.lever_m = keyframes.lever_m;
  if (std::abs(turned) > 1e-6) out.scene.turn_rad = turned;
  return out;
}

Pose placed(const ModelFrame& frame, const std::vector<DisturbanceModel>& models,
            const ModelScene& scene) {
  ModelFrame out = frame;
  for (const DisturbanceModel& model : models) {
    const Twist twist = basis_of(model, out, scene) * model.values;
    // A rotation may be large.
    const Pose motion = turns(model.kind)
                            ? rotation_about_y(twist[1] / scene.lever_m)
                            : estimation::exp_about(scene.middle, twist, scene.lever_m);
    out.T_table_sensor = motion * out.T_table_sensor;
  }
  return out.T_table_sensor;
}

Result<std::vector<DisturbanceModel>> find_models(const Keyframes& keyframes,
                                                  const ModelFrames& frames, const PoseGraph& graph,
                                                  const RunContext& context) {
  return ModelSearch(keyframes, frames, context).run(graph);
}

}  // namespace turnscan::placement
