#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/turntable/motion/motor_law.hpp>
#include <turnscan/turntable/motion/pair_selection.hpp>

namespace turnscan::motion {

namespace {

constexpr double kStandsWithin = 0.2 * kRadiansPerDegree;
constexpr double kClearEvidence = 8.0;  ///< difference of MotionSolution::minus_2_log_evidence

}  // namespace

bool find_transients(const MotionData& data, const MotionState& state, AnglePrior& prior) {
  const auto& keys = data.keys;
  const auto time = [&](std::size_t k) { return data.frames[keys[k]].time_s; };
  std::vector<double> speed(keys.size(), 0.0);
  const double half = std::max(0.4, 1.5 * (time(1) - time(0)));
  for (std::size_t k = 0, a = 0, b = 0; k < keys.size(); ++k) {
    while (time(k) - time(a) > half) ++a;
    while (b + 1 < keys.size() && time(b) - time(k) < half) ++b;
    // Across a gap in the frames at least the neighbours.
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
    count -= count / 4;  // it moved already when that could be seen
    for (std::size_t i = 0; i < count && count > 2; ++i) prior.still[index(i)] = 1;
  };
  walk([](std::size_t i) { return i; });
  walk([n](std::size_t i) { return n - 1 - i; });
}

Result<> choose_speed_walk(const MotionData& data, const MotionSolution& solution,
                           SolveOptions options, AnglePrior& prior, MotionState& state,
                           const RunContext& context) {
  const auto pairs = select_pairs(data, state.angle, false);
  options.scale_m = solution.scale_m;
  options.variance_m2 = solution.variance_m2;
  options.iterations = 4;
  options.reach_m = std::max(0.004, 12.0 * solution.scale_m);
  std::optional<MotionSolution> best;
  double speed_walk = prior.speed_walk;
  for (const double share : {2e-4, 1e-3, 2.5e-3, 6e-3, 1.5e-2}) {
    prior.speed_walk = share;
    TURNSCAN_ASSIGN(MotionSolution tried,
                    solve_pairwise(data, state, pairs, prior, options, context));
    // The steadiest of those that are about as probable.
    if (best && best->minus_2_log_evidence <= tried.minus_2_log_evidence + kClearEvidence) continue;
    best = std::move(tried);
    speed_walk = share;
  }
  prior.speed_walk = speed_walk;
  state = best->state;
  return {};
}

}  // namespace turnscan::motion
