#include <algorithm>
#include <cmath>
#include <optional>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/parallel.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/motion/axis.hpp>
#include <turnscan/turntable/motion/initial_guess.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>

namespace turnscan::motion {

namespace {

/// A point on the axis: the visible surface is in front of it by about a quarter of the object's
/// width.
Vec3d behind_surface(const MotionData& data, const Vec3d& axis, double depth) {
  const Vec3d view = (data.to_sensor - data.to_sensor.dot(axis) * axis).normalized();
  const Vec3d side = axis.cross(view);
  double width = 0.0;
  for (const Vec3f& p : data.cloud) width += std::abs(side.dot(p.cast<double>() - data.middle));
  width /= double(std::max<std::size_t>(1, data.cloud.size()));
  return data.middle - depth * width * view;
}

std::vector<FramePair> spread_pairs(const MotionData& data, std::size_t gap,
                                    std::size_t max_pairs) {
  std::vector<FramePair> out;
  for (const std::size_t i : evenly_spread(data.keys.size() - gap, max_pairs)) {
    const std::size_t a = data.keys[i], b = data.keys[i + gap];
    if (data.frames[a].samples.size() < 30 || data.frames[b].surface.empty()) continue;
    if (data.frames[a].pass != data.frames[b].pass) continue;
    out.push_back({std::uint32_t(a), std::uint32_t(b)});
  }
  return out;
}

/// Mean cost of the pairs at each constant speed.
std::vector<double> costs_of_speeds(const MotionData& data, const MotionState& axis,
                                    const std::vector<FramePair>& pairs,
                                    const std::vector<double>& speeds) {
  std::vector<double> costs(speeds.size(), 1.0);
  parallel_for(speeds.size(), 1, [&](std::size_t k) {
    double sum = 0.0;
    for (const FramePair& pair : pairs) {
      const double dt = data.frames[pair.to].time_s - data.frames[pair.from].time_s;
      sum += pair_cost(data, axis, pair, speeds[k] * dt, data.inlier_gate_m(), 200);
    }
    costs[k] = sum / double(pairs.size());
  });
  return costs;
}

/// Time from one key frame to the next.
double key_step_s(const MotionData& data) {
  std::vector<double> steps;
  for (std::size_t k = 0; k + 1 < data.keys.size(); ++k)
    steps.push_back(data.frames[data.keys[k + 1]].time_s - data.frames[data.keys[k]].time_s);
  return median(steps);
}

/// Number of pairs of frames compared, and the minimum for a conclusion.
constexpr std::size_t kRecurrencePairs = 16, kMinRecurringPairs = 4;
/// Maximum cost of recurring views relative to that of frames with different views.
constexpr double kRecurs = 0.6;
/// And relative to the smallest such cost, for those of other turns.
constexpr double kAsDeep = 1.5;
/// Maximum increase of the cost of pairs about this far apart at the speed at which views return.
constexpr double kLittleWorse = 1.5, kPlainTurn = 5.0 * kRadiansPerDegree;
/// Maximum factor by which the speed from neighbouring pairs may be wrong.
constexpr double kFarthestSpeed = 3.0;

/// Typical cost of frames with this distance in key frames, as if nothing had turned.
double recurrence_cost(const MotionData& data, std::size_t gap) {
  const auto pairs = spread_pairs(data, gap, kRecurrencePairs);
  if (pairs.size() < kMinRecurringPairs) return 1.0;
  std::vector<double> costs;
  for (const FramePair& pair : pairs)
    costs.push_back(pair_cost(data, MotionState(), pair, 0.0, data.inlier_gate_m(), 300));
  return median(costs);
}

/// Best rotation between two frames near a guess, by golden section after a coarse search.
double best_turn(const MotionData& data, const MotionState& state,
                 const std::vector<FramePair>& pairs, const std::vector<double>& offset,
                 double guess, double reach, double sigma_rad) {
  const auto cost = [&](double turn) {
    double sum = 0.0;
    for (std::size_t k = 0; k < pairs.size(); ++k)
      sum += pair_cost(data, state, pairs[k], turn + offset[k], data.inlier_gate_m(), 150);
    return sum / double(pairs.size()) + 1e-3 * std::pow((turn - guess) / sigma_rad, 2);
  };
  const int steps = 6;
  double best = guess, least = cost(guess);
  for (int k = -steps; k <= steps; ++k) {
    const double turn = guess + reach * k / steps, here = cost(turn);
    if (here < least) best = turn, least = here;
  }
  double low = best - reach / steps, high = best + reach / steps;
  for (int i = 0; i < 6; ++i) {
    const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
    (cost(a) < cost(b) ? high : low) = cost(a) < cost(b) ? b : a;
  }
  return 0.5 * (low + high);
}

/// Angles of the frames between key frames.
void interpolate(const MotionData& data, std::vector<double>& angle) {
  for (std::size_t k = 0; k + 1 < data.keys.size(); ++k) {
    const std::size_t a = data.keys[k], b = data.keys[k + 1];
    const double ta = data.frames[a].time_s, tb = data.frames[b].time_s;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double t = data.frames[i].time_s;
      const bool timed = std::isfinite(t) && tb > ta;
      const double share = timed ? (t - ta) / (tb - ta) : double(i - a) / double(b - a);
      angle[i] = angle[a] + share * (angle[b] - angle[a]);
    }
  }
}

const double kLowestSensor = -std::sin(15.0 * kRadiansPerDegree);

/// Axes near a direction that is about up for the sensor, which looks down.
void add_axes(const MotionData& data, const Vec3d& up, std::vector<MotionState>& out) {
  MotionState state;
  state.angle.assign(data.frames.size(), 0.0);
  const Vec3d across = up.cross(data.to_sensor);
  // From directly above the direction towards the sensor is undefined: use any.
  const Vec3d right = across.norm() > 0.05 ? Vec3d(across.normalized()) : tangent_basis(up).first;
  for (const double tilt : {0.0, 20.0, 40.0, 60.0}) {
    for (const double roll : {0.0, 15.0, -15.0}) {
      if (roll != 0.0 && tilt > 50.0) continue;
      // Looking down tilts the axis towards the sensor.
      state.axis = Eigen::AngleAxisd(roll * kRadiansPerDegree, data.to_sensor) *
                   (Eigen::AngleAxisd(tilt * kRadiansPerDegree, right) * up);
      for (const double depth : {0.9, 0.3, 1.6}) {
        if (depth != 0.9 && (roll != 0.0 || data.projective)) continue;
        state.center = behind_surface(data, state.axis, depth);
        out.push_back(state);
      }
    }
  }
}

}  // namespace

std::vector<MotionState> candidate_axes(const MotionData& data,
                                        const std::optional<TurntableInfo>& hint) {
  std::vector<MotionState> out;
  MotionState state;
  state.angle.assign(data.frames.size(), 0.0);
  if (data.platter || hint) {
    state.axis = data.platter ? data.platter->axis : hint->axis.normalized();
    state.center = data.platter ? data.platter->center_m : hint->center_m;
    // The point of the axis beside the object: tilts about it move the object least.
    state.center += state.axis.dot(data.middle - state.center) * state.axis;
    out.push_back(state);
    return out;
  }
  if (data.projective) {
    add_axes(data, -Vec3d::UnitY(), out);
    return out;
  }
  // Clouds have y or z upright; sensors do not look up much.
  for (const Vec3d& line : {Vec3d(Vec3d::UnitY()), Vec3d(Vec3d::UnitZ())})
    for (const Vec3d& up : {line, Vec3d(-line)})
      if (up.dot(data.to_sensor) > kLowestSensor) add_axes(data, up, out);
  return out;
}

double guess_speed(const MotionData& data, const MotionState& axis) {
  const double dt = key_step_s(data);
  if (!(dt > 0.0)) return 0.0;
  double best = 0.0, reach = 60.0 * kRadiansPerDegree / dt;
  for (std::size_t gap = 1; gap < data.keys.size(); gap *= 2) {
    const double span = dt * double(gap);
    const auto pairs = spread_pairs(data, gap, 24);
    if (pairs.size() < 2) break;
    const double step = 0.5 * kRadiansPerDegree / span;
    const int half = int(std::ceil(reach / step));
    std::vector<double> speeds;
    for (int k = -half; k <= half; ++k) speeds.push_back(best + step * k);
    const auto costs = costs_of_speeds(data, axis, pairs, speeds);
    best = speeds[std::size_t(std::min_element(costs.begin(), costs.end()) - costs.begin())];
    reach = 3.0 * step;
    if (std::abs(best) * span > 20.0 * kRadiansPerDegree) break;
  }
  return best;
}

std::vector<double> recurrence_costs(const MotionData& data) {
  std::vector<double> out(data.keys.size(), 1.0);
  parallel_for(out.size(), 1, [&](std::size_t gap) {
    if (gap > 0) out[gap] = recurrence_cost(data, gap);
  });
  return out;
}

std::optional<double> recurrence_speed(const MotionData& data, const std::vector<double>& cost,
                                       const MotionState& state, double guess) {
  const double dt = key_step_s(data);
  const std::size_t n = cost.size();
  std::vector<double> known;
  for (const double c : cost)
    if (c < 1.0) known.push_back(c);
  const double usual = median(known);
  double deepest = usual;
  for (std::size_t gap = 2; gap + 1 < n; ++gap)
    if (cost[gap] < cost[gap - 1] && cost[gap] <= cost[gap + 1])
      deepest = std::min(deepest, cost[gap]);
  const double most = std::min(kRecurs * usual, kAsDeep * deepest);
  std::optional<double> best;
  for (std::size_t gap = 2; gap + 1 < n; ++gap) {
    // A dip that may continue beyond the last known gap is not a minimum yet.
    if (cost[gap] > most || cost[gap] > cost[gap - 1] || cost[gap] > cost[gap + 1] ||
        cost[gap + 1] == 1.0)
      continue;
    const double left = cost[gap - 1] - cost[gap], right = cost[gap + 1] - cost[gap];
    const double middle = double(gap) + 0.5 * (left - right) / std::max(left + right, 1e-9);
    const double speed = std::copysign(kTurn / (middle * dt), guess);
    const auto apart = [&](double s) { return std::abs(std::log(s / guess)); };
    if (apart(speed) < std::log(kFarthestSpeed) && (!best || apart(speed) < apart(*best)))
      best = speed;
  }
  if (!best) return best;
  // An object that looks alike from two sides recurs after half a turn, but does not turn by a
  // whole one.
  const double step = std::abs(guess * dt);
  const auto gap = std::clamp<std::size_t>(std::size_t(std::lround(kPlainTurn / step)), 1, 8);
  if (gap >= n) return std::nullopt;
  const auto pairs = spread_pairs(data, gap, 24);
  if (pairs.empty()) return std::nullopt;
  const auto costs = costs_of_speeds(data, state, pairs, {guess, *best});
  if (costs[1] > kLittleWorse * costs[0]) return std::nullopt;
  return best;
}

void track_angles(const MotionData& data, MotionState& state, double step_sigma) {
  const std::vector<double> predicted = state.angle;
  for (std::size_t k = 1; k < data.keys.size(); ++k) {
    const std::size_t now = data.keys[k], last = data.keys[k - 1];
    const double guess = predicted[now] - predicted[last];
    std::vector<FramePair> pairs;
    std::vector<double> offset;
    for (const std::size_t back : {1U, 3U, 6U}) {
      if (back > k) continue;
      const std::size_t then = data.keys[k - back];
      if (data.frames[then].surface.empty() || data.frames[now].samples.size() < 30) continue;
      if (data.frames[then].pass != data.frames[now].pass) continue;
      // From the later to the earlier frame, so that the rotation is negative.
      pairs.push_back({std::uint32_t(now), std::uint32_t(then)});
      offset.push_back(-(state.angle[last] - state.angle[then]));
    }
    double turn = guess;
    if (!pairs.empty()) {
      const double reach = std::max(1.2 * std::abs(guess), 1.0 * kRadiansPerDegree);
      turn =
          -best_turn(data, state, pairs, offset, -guess, std::min(reach, 15.0 * kRadiansPerDegree),
                     std::max(step_sigma * std::abs(guess), 0.2 * kRadiansPerDegree));
    }
    state.angle[now] = state.angle[last] + turn;
  }
  interpolate(data, state.angle);
}

void search_turns(const MotionData& data, MotionState& state) {
  for (std::size_t k = 1; k < data.keys.size(); ++k) {
    const std::size_t now = data.keys[k], last = data.keys[k - 1];
    const FramePair pair{std::uint32_t(last), std::uint32_t(now)};
    const FramePair back{std::uint32_t(now), std::uint32_t(last)};
    std::vector<double> costs(180, 1.0);
    const auto cost = [&](double turn) {
      return 0.5 * (pair_cost(data, state, pair, turn, data.inlier_gate_m(), 800) +
                    pair_cost(data, state, back, -turn, data.inlier_gate_m(), 800));
    };
    parallel_for(costs.size(), 1, [&](std::size_t i) {
      costs[i] = cost((2.0 * double(i) - 179.0) * kRadiansPerDegree);
    });
    const auto best = std::min_element(costs.begin(), costs.end());
    double turn = (2.0 * double(best - costs.begin()) - 179.0) * kRadiansPerDegree, least = *best;
    for (int i = -10; i <= 10; ++i) {
      const double near = turn + 0.2 * i * kRadiansPerDegree, here = cost(near);
      if (here < least) least = here, turn = near;
    }
    state.angle[now] = state.angle[last] + turn;
  }
  interpolate(data, state.angle);
}

}  // namespace turnscan::motion
