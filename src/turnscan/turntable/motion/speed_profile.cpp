#include <algorithm>
#include <bit>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>
#include <turnscan/turntable/motion/speed_profile.hpp>

namespace turnscan::motion {

namespace {

constexpr double kStandsWithin = 0.2 * kRadiansPerDegree;
constexpr double kClearEvidence = 8.0;  ///< difference of MotionSolution::minus_2_log_evidence
/// Minimum advantage of a slip over an uneven rotation (difference of minus_2_log_evidence), and
/// its minimum size.
constexpr double kSlipEvidence = 30.0, kMinSlip = 1.0 * kRadiansPerDegree;
constexpr std::size_t kMaxSlips = 3;
/// Effect of a slip on a prior of even rotation: the speed deviates for a while by this multiple of
/// its usual variation, until it falls to this share of its peak.
constexpr double kBumpPeak = 2.0, kBumpEnd = 0.1;
/// Maximum excess of pair_cost() across a slip over that beside it; maximum distance of the pairs
/// in key frames, and from the slip.
constexpr double kMaxCostAcross = 0.3;
constexpr std::size_t kSpanAcross = 3, kBeside = 12, kSpeedCostSamples = 250;

/// Options for comparing priors, with everything else equal. solution: with one of them.
SolveOptions trial_options(SolveOptions options, const MotionSolution& solution) {
  options.scale_m = solution.scale_m;
  options.variance_m2 = solution.variance_m2;
  options.iterations = 4;
  options.reach_m = std::max(0.004, 12.0 * solution.scale_m);
  return options;
}

/// Finds slips in angles that were fitted without them.
class SlipSearch {
 public:
  SlipSearch(const MotionData& data, const MotionSolution& solution, SolveOptions options,
             AnglePrior& prior, MotionState& state)
      : data_(data),
        options_(trial_options(std::move(options), solution)),
        prior_(prior),
        state_(state) {}

  Result<> run(const RunContext& context) {
    for (std::size_t n = 0; n < kMaxSlips; ++n) {
      const auto bump = largest_bump();
      if (!bump) return {};
      pairs_ = select_pairs(data_, state_.angle, false);
      TURNSCAN_ASSIGN(const MotionSolution without,
                      solve_pairwise(data_, state_, pairs_, prior_, options_, context));
      TURNSCAN_ASSIGN(Trial best, best_gap(*bump, context));
      const double needed = is_transient(bump->peak) ? kClearEvidence : kSlipEvidence;
      if (best.evidence() + needed > without.minus_2_log_evidence) return {};
      if (cost_across(best) > kMaxCostAcross) {
        prior_.unjoined = Break{frame(bump->first + 1), slip_of(best)};
        return {};
      }
      state_ = std::move(best.solution.state);
      prior_ = std::move(best.prior);
    }
    return {};
  }

 private:
  /// Gaps between key frames, each identified by the key before it, in which the speed deviates.
  struct Bump {
    std::size_t first = 0, last = 0, peak = 0;
  };

  struct Trial {
    std::size_t gap = 0;
    AnglePrior prior;
    MotionSolution solution;

    double evidence() const { return solution.minus_2_log_evidence; }
  };

  std::size_t gaps() const { return data_.keys.size() - 1; }
  std::size_t frame(std::size_t k) const { return data_.keys[k]; }
  double time(std::size_t k) const { return data_.frames[frame(k)].time_s; }
  double speed(std::size_t k) const {
    return (state_.angle[frame(k + 1)] - state_.angle[frame(k)]) / (time(k + 1) - time(k));
  }

  double slip_of(const Trial& trial) const {
    const auto& angle = trial.solution.state.angle;
    return angle[frame(trial.gap + 1)] - angle[frame(trial.gap)] -
           prior_.speed_rad_s * (time(trial.gap + 1) - time(trial.gap));
  }

  bool is_transient(std::size_t k) const {
    return !prior_.transient.empty() && prior_.transient[frame(k)] != 0;
  }

  /// Where the table is known to start, stop or slip, and between two passes.
  bool is_known(std::size_t k) const {
    if (data_.frames[frame(k)].pass != data_.frames[frame(k + 1)].pass) return true;
    if (!prior_.slips.empty() && prior_.slips[frame(k)] != 0) return true;
    if (!is_transient(k)) return false;
    const auto& transient = prior_.transient;
    const auto marked = [](std::uint8_t flag) { return flag != 0; };
    return std::all_of(transient.begin(), transient.begin() + std::ptrdiff_t(frame(k)), marked) ||
           std::all_of(transient.begin() + std::ptrdiff_t(frame(k)), transient.end(), marked);
  }

  std::optional<Bump> largest_bump() const {
    std::vector<double> off(gaps(), 0.0), sizes, speeds;
    for (std::size_t k = 0; k < gaps(); ++k)
      if (!is_known(k)) speeds.push_back(speed(k));
    if (speeds.empty()) return std::nullopt;
    const double usual = median(speeds);
    for (std::size_t k = 0; k < gaps(); ++k) {
      if (is_known(k)) continue;
      off[k] = speed(k) - usual;
      sizes.push_back(std::abs(off[k]));
    }
    Bump out;
    for (std::size_t k = 0; k < gaps(); ++k)
      if (std::abs(off[k]) > std::abs(off[out.peak])) out.peak = k;
    const double peak = off[out.peak];
    if (std::abs(peak) < kBumpPeak * median(sizes)) return std::nullopt;
    const auto inside = [&](std::size_t k) { return off[k] / peak > kBumpEnd; };
    out.first = out.last = out.peak;
    while (out.first > 0 && inside(out.first - 1)) --out.first;
    while (out.last + 1 < gaps() && inside(out.last + 1)) ++out.last;
    double turn_rad = 0.0;
    for (std::size_t k = out.first; k <= out.last; ++k)
      turn_rad += off[k] * (time(k + 1) - time(k));
    return std::abs(turn_rad) < kMinSlip ? std::nullopt : std::optional(out);
  }

  /// The gap of the bump in which a slip explains most.
  Result<Trial> best_gap(const Bump& bump, const RunContext& context) const {
    std::size_t at = bump.peak;
    TURNSCAN_ASSIGN(Trial best, with_slip(bump, at, context));
    for (std::size_t step = std::bit_floor(bump.last - bump.first + 1) / 2; step > 0; step /= 2) {
      for (const std::size_t k : {at - step, at + step}) {
        if (k < bump.first || k > bump.last) continue;  // indices below zero wrap around
        TURNSCAN_ASSIGN(Trial tried, with_slip(bump, k, context));
        if (tried.evidence() >= best.evidence()) continue;
        best = std::move(tried);
        at = k;
      }
    }
    return best;
  }

  /// Even rotation up to the gap and after it.
  Result<Trial> with_slip(const Bump& bump, std::size_t gap, const RunContext& context) const {
    Trial out{gap, prior_, {}};
    MotionState start = state_;
    const std::size_t before = frame(bump.first), after = frame(bump.last + 1);
    out.prior.slips.resize(state_.angle.size(), 0);
    for (std::size_t i = before; i <= after; ++i) {
      const std::size_t end = i <= frame(gap) ? before : after;
      start.angle[i] = state_.angle[end] +
                       prior_.speed_rad_s * (data_.frames[i].time_s - data_.frames[end].time_s);
      if (i >= frame(gap) && i < frame(gap + 1)) out.prior.slips[i] = 1;
      if (!out.prior.transient.empty()) out.prior.transient[i] = 0;
    }
    TURNSCAN_ASSIGN(out.solution,
                    solve_pairwise(data_, start, pairs_, out.prior, options_, context));
    return out;
  }

  /// Excess of the misfit of views on both sides of a slip over that of views on one side, at the
  /// same distance in key frames: views of the two sides of a plate seen edge on fit each other at
  /// any rotation.
  double cost_across(const Trial& trial) const {
    const MotionState& state = trial.solution.state;
    double across = 0.0, beside = 0.0, pairs_across = 0.0, pairs_beside = 0.0;
    const std::size_t begin = trial.gap - std::min(trial.gap, kBeside);
    const std::size_t end = std::min(trial.gap + 1 + kBeside, gaps());
    for (std::size_t a = begin; a < end; ++a) {
      for (std::size_t b = a + 1; b <= std::min(a + kSpanAcross, end); ++b) {
        const auto from = std::uint32_t(frame(a)), to = std::uint32_t(frame(b));
        const double turn = state.angle[to] - state.angle[from], gate = data_.inlier_gate_m();
        const double cost = pair_cost(data_, state, {from, to}, turn, gate, kSpeedCostSamples) +
                            pair_cost(data_, state, {to, from}, -turn, gate, kSpeedCostSamples);
        const bool crosses = a <= trial.gap && b > trial.gap;
        (crosses ? across : beside) += 0.5 * cost;
        (crosses ? pairs_across : pairs_beside) += 1.0;
      }
    }
    return across / pairs_across - beside / std::max(pairs_beside, 1.0);
  }

  const MotionData& data_;
  SolveOptions options_;
  AnglePrior& prior_;
  MotionState& state_;
  std::vector<FramePair> pairs_;
};

}  // namespace

bool find_transients(const MotionData& data, const MotionState& state, AnglePrior& prior) {
  const auto& keys = data.keys;
  const auto time = [&](std::size_t k) { return data.frames[keys[k]].time_s; };
  std::vector<double> speed(keys.size(), 0.0);
  const double half = std::max(0.4, 1.5 * (time(1) - time(0)));
  for (std::size_t k = 0, a = 0, b = 0; k < keys.size(); ++k) {
    while (time(k) - time(a) > half) ++a;
    while (b + 1 < keys.size() && time(b) - time(k) < half) ++b;
    // Across a gap in the frames use at least the neighbours.
    const std::size_t from = a < b || k == 0 ? a : k - 1;
    const std::size_t to = a < b ? b : std::min(k + 1, keys.size() - 1);
    speed[k] = (state.angle[keys[to]] - state.angle[keys[from]]) / (time(to) - time(from));
  }
  std::vector<double> sorted = speed;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  prior.speed_rad_s = usual;
  prior.transient.assign(data.frames.size(), 0);
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (std::abs(speed[k] / usual - 1.0) < 0.15) continue;
    for (std::size_t i = 0; i < data.frames.size(); ++i) {
      if (std::abs(data.frames[i].time_s - time(k)) < half) prior.transient[i] = 1;
    }
  }
  return std::count(prior.transient.begin(), prior.transient.end(), 1) > 0;
}

void find_standstills(const MotionState& state, AnglePrior& prior) {
  const std::size_t n = state.angle.size();
  prior.still.assign(n, 0);
  const auto walk = [&](auto index) {
    double sum = 0.0;
    std::size_t count = 0;
    for (; count < n / 2; ++count) {
      const double a = state.angle[index(count)];
      if (prior.transient[index(count)] == 0) break;
      if (count > 0 && std::abs(a - sum / double(count)) > kStandsWithin) break;
      sum += a;
    }
    count -= count / 4;  // it had already moved before that was detectable
    for (std::size_t i = 0; i < count && count > 2; ++i) prior.still[index(i)] = 1;
  };
  walk([](std::size_t i) { return i; });
  walk([n](std::size_t i) { return n - 1 - i; });
}

Result<> find_slips(const MotionData& data, const MotionSolution& solution, SolveOptions options,
                    AnglePrior& prior, MotionState& state, const RunContext& context) {
  return SlipSearch(data, solution, std::move(options), prior, state).run(context);
}

Result<> choose_speed_walk(const MotionData& data, const MotionSolution& solution,
                           SolveOptions options, AnglePrior& prior, MotionState& state,
                           const RunContext& context) {
  const auto pairs = select_pairs(data, state.angle, false);
  options = trial_options(std::move(options), solution);
  std::optional<MotionSolution> best;
  double speed_walk = prior.speed_walk;
  for (const double share : {2e-4, 1e-3, 2.5e-3, 6e-3, 1.5e-2}) {
    prior.speed_walk = share;
    TURNSCAN_ASSIGN(MotionSolution tried,
                    solve_pairwise(data, state, pairs, prior, options, context));
    // The steadiest of those with about the same probability.
    if (best && best->minus_2_log_evidence <= tried.minus_2_log_evidence + kClearEvidence) continue;
    best = std::move(tried);
    speed_walk = share;
  }
  prior.speed_walk = speed_walk;
  state = best->state;
  return {};
}

}  // namespace turnscan::motion
