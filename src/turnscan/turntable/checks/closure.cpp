#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/median.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/geometry/estimation/robust.hpp>
#include <turnscan/geometry/registration/registration.hpp>
#include <turnscan/turntable/checks/closure.hpp>
#include <turnscan/turntable/checks/recorded_angles.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>

namespace turnscan::checks {

namespace {

using motion::MotionData;
using motion::MotionFrame;
using motion::SurfaceSample;

constexpr std::size_t kMaxPairs = 6;
/// Maximum angle between frames with nearly the same view: a wrong axis or speed moves one relative
/// to the other by at most a tenth of its effect half a turn apart.
constexpr double kSameView = 12.0 / kDegreesPerRadian;
constexpr double kMinLever = 0.02;  // share of a rotation visible along the normals; noise alone is
                                    // less
/// Number of standard deviations of few, noisy pairs that are attributed to chance.
constexpr double kChance = 2.5;
/// Standard deviation of a median of normal values over that of their mean, and over the median
/// deviation.
constexpr double kMedianOverMean = 1.25;

struct TurnPair {
  std::size_t first, second;
  std::size_t beside = 0;  ///< frame next to the first, with the same view; equals the first if
                           ///< there is none
};

std::size_t frame_beside(const FrameSequence& sequence, const std::vector<double>& angle,
                         std::size_t first) {
  for (std::size_t k = first + 1; k < angle.size(); ++k)
    if (std::abs(angle[k] - angle[first]) < kSameView &&
        sequence.frames()[k].pass == sequence.frames()[first].pass)
      return k;
  return first;
}

/// Frames in the order of their angles, without those that have none.
std::vector<std::size_t> by_angle(const std::vector<double>& angle) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < angle.size(); ++i)
    if (std::isfinite(angle[i])) out.push_back(i);
  std::sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
    return angle[a] < angle[b] || (angle[a] == angle[b] && a < b);
  });
  return out;
}

/// The later frame of the same pass that comes nearest to a turn from frame i, and the first of
/// equally near ones; i if none is nearer than `reach`.
std::size_t partner_of(std::size_t i, const FrameSequence& sequence,
                       const std::vector<double>& angle, const std::vector<std::size_t>& sorted,
                       double reach) {
  constexpr double kRounding = 1e-9;
  std::size_t best = i;
  double least = reach;
  for (const double turn : {-kTurn, kTurn}) {
    const double from = angle[i] + turn - reach - kRounding,
                 to = angle[i] + turn + reach + kRounding;
    auto at = std::lower_bound(sorted.begin(), sorted.end(), from,
                               [&](std::size_t k, double value) { return angle[k] < value; });
    for (; at != sorted.end() && angle[*at] <= to; ++at) {
      const std::size_t k = *at;
      const double off = std::abs(std::abs(angle[k] - angle[i]) - kTurn);
      if (k <= i || sequence.frames()[k].pass != sequence.frames()[i].pass) continue;
      if (off < least || (off == least && best != i && k < best)) best = k, least = off;
    }
  }
  return best;
}

/// Frames one turn apart, spread over those that have a partner.
Result<std::vector<TurnPair>> turn_pairs(const FrameSequence& sequence,
                                         const std::vector<double>& angle,
                                         const RunContext& context) {
  std::vector<TurnPair> all;
  std::vector<double> steps;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    if (std::isfinite(angle[i] - angle[i - 1])) steps.push_back(std::abs(angle[i] - angle[i - 1]));
  }
  const double reach = std::max(1.5 / kDegreesPerRadian, steps.empty() ? 0.0 : 0.6 * median(steps));
  const std::vector<std::size_t> sorted = by_angle(angle);
  for (std::size_t i = 0; i < angle.size(); ++i) {
    TURNSCAN_TRY(context.check());
    if (!std::isfinite(angle[i])) continue;
    const std::size_t partner = partner_of(i, sequence, angle, sorted, reach);
    if (partner != i) all.push_back({i, partner});
  }
  auto chosen = evenly_spread_to_last(std::move(all), kMaxPairs);
  for (TurnPair& pair : chosen) pair.beside = frame_beside(sequence, angle, pair.first);
  return chosen;
}

struct PairClosure {
  double turn_rad, shift_m;
};

/// Displacement of the first frame's points by unconstrained registration from the pose of the
/// calibration. Only the part along the normals counts: a plate slides in its plane and a cylinder
/// rotates about itself at no cost, and there registration is arbitrary.
std::optional<PairClosure> compare_frames(const MotionFrame& first, const MotionFrame& second,
                                          const TurntableInfo& table, double turn,
                                          const RunContext& context) {
  if (first.samples.size() < 100 || second.samples.size() < 100) return std::nullopt;
  std::vector<Vec3f> points, targets, normals;
  const Vec3d axis = table.axis.normalized();
  const Eigen::AngleAxisd R(turn, axis);
  for (const SurfaceSample& s : first.samples)
    points.push_back((table.center_m + R * (s.p.cast<double>() - table.center_m)).cast<float>());
  for (const SurfaceSample& s : second.samples) {
    targets.push_back(s.p);
    normals.push_back(s.n);
  }
  IcpOptions options;
  options.max_distance_m = 0.02;
  options.tolerance_m = 2e-5;
  options.max_iterations = 200;
  const auto found = icp(points, targets, normals, Pose::Identity(), options, context);
  if (!found) return std::nullopt;
  double moved = 0.0, moved_by_turn = 0.0, lever = 0.0, reach = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3d p = points[i].cast<double>();
    const Vec3d n = R * first.samples[i].n.cast<double>();
    const double along = n.dot(found->T_target_source * p - p);
    const Vec3d tangent = axis.cross(p - table.center_m);
    const double per_radian = n.dot(tangent);
    moved += along * along;
    moved_by_turn += along * per_radian;
    lever += per_radian * per_radian;
    reach += tangent.squaredNorm();
  }
  // If normals point in all directions, they see a third of a displacement's square.
  const double shift = std::sqrt(3.0 * moved / double(points.size()));
  const bool shown = lever > kMinLever * reach;
  return PairClosure{shown ? moved_by_turn / lever : std::nan(""), shift};
}

struct Measured {
  double value, sigma;
};

/// The median, and its standard deviation from the scatter of the values about it.
Measured median_of(std::vector<double> values) {
  const double middle = median(values);
  std::vector<double> off;
  for (const double value : values) off.push_back(std::abs(value - middle));
  return {middle, kMedianOverMean * estimation::kMadToSigma * median(off) /
                      std::sqrt(double(values.size()))};
}

double squared(double value) { return value * value; }

/// turns, shifts: of pairs a turn apart; those of neighbours, which only noise rotates and shifts,
/// show how far chance alone moves a pair, even if there are few pairs.
ClosureError closure_of(const std::vector<PairClosure>& pairs,
                        const std::vector<PairClosure>& neighbours) {
  ClosureError out;
  out.pairs = pairs.size();
  std::vector<double> turns, shifts, squares, noises, noise_squares;
  for (const PairClosure& pair : pairs) {
    if (std::isfinite(pair.turn_rad)) turns.push_back(pair.turn_rad);
    shifts.push_back(pair.shift_m);
    squares.push_back(squared(pair.shift_m));
  }
  double noise_turns = 0.0, count = 0.0;
  for (const PairClosure& pair : neighbours) {
    if (std::isfinite(pair.turn_rad)) noise_turns += squared(pair.turn_rad), count += 1.0;
    noises.push_back(pair.shift_m);
    noise_squares.push_back(squared(pair.shift_m));
  }
  out.shift_m = median(shifts);
  out.noise_m = median(noises);
  out.excess_sigma_m2 = median_of(squares).sigma;
  if (!noises.empty())
    out.excess_sigma_m2 = std::hypot(out.excess_sigma_m2, median_of(noise_squares).sigma);
  const Measured turn = turns.empty() ? Measured{std::nan(""), 0.0} : median_of(turns);
  out.turn_rad = turn.value;
  out.turn_sigma_rad = turn.sigma;
  if (count > 0.0 && !turns.empty())
    out.turn_sigma_rad = std::max(
        turn.sigma, kMedianOverMean * std::sqrt(noise_turns / count / double(turns.size())));
  return out;
}

/// The frames of the pairs, in the order of their positions.
std::vector<std::size_t> positions_of(const std::vector<TurnPair>& pairs) {
  std::vector<std::size_t> out;
  for (const TurnPair& pair : pairs) {
    out.push_back(pair.first);
    out.push_back(pair.second);
    out.push_back(pair.beside);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// data: of the frames at `positions`.
Result<std::optional<ClosureError>> compare_pairs(const std::vector<TurnPair>& pairs,
                                                  const std::vector<std::size_t>& positions,
                                                  const std::vector<double>& angle,
                                                  const TurntableInfo& table,
                                                  const MotionData& data,
                                                  const RunContext& context) {
  std::vector<PairClosure> found, neighbours;
  const auto frame_at = [&](std::size_t position) -> const MotionFrame& {
    const auto at = std::lower_bound(positions.begin(), positions.end(), position);
    return data.frames[std::size_t(at - positions.begin())];
  };
  for (const TurnPair& pair : pairs) {
    TURNSCAN_TRY(context.check());
    const auto between = [&](std::size_t other) {
      return compare_frames(frame_at(pair.first), frame_at(other), table,
                            angle[other] - angle[pair.first], context);
    };
    const auto closure = between(pair.second);
    if (!closure) continue;
    found.push_back(*closure);
    const auto noise = pair.beside != pair.first ? between(pair.beside) : std::nullopt;
    if (noise) neighbours.push_back(*noise);
  }
  if (found.size() < 2) return std::nullopt;
  return closure_of(found, neighbours);
}

}  // namespace

}  // namespace turnscan::checks

namespace turnscan {

bool ClosureError::significant() const {
  using checks::kChance;
  constexpr double kMax_m = 0.0015;
  const double excess = shift_m * shift_m - noise_m * noise_m;
  return excess > kMax_m * kMax_m + kChance * excess_sigma_m2 ||
         (std::isfinite(turn_rad) &&
          std::abs(turn_rad) > std::hypot(1.0 / kDegreesPerRadian, kChance * turn_sigma_rad));
}

std::string ClosureError::offset_text() const {
  const std::string shift = fmt::format("{:.2f} mm", shift_m * 1e3);
  if (!std::isfinite(turn_rad)) return shift;
  return fmt::format("{} and {:+.2f} deg", shift, turn_rad * kDegreesPerRadian);
}

std::string ClosureError::noise_text() const {
  return noise_m > 0.0 ? fmt::format("noise alone makes {:.2f} mm", noise_m * 1e3)
                       : "how much of it is noise is not known: no frames are near enough";
}

Result<std::optional<ClosureError>> measure_closure(const FrameSequence& sequence,
                                                    const RunContext& context,
                                                    PlatterMemory* memory) {
  const auto& table = sequence.header().turntable;
  if (!table)
    return fail(ErrorCode::kMissingData, "the recording does not say where the turntable is");
  const auto angle = checks::recorded_angles(sequence);
  if (std::none_of(angle.begin(), angle.end(), [](double a) { return std::isfinite(a); }))
    return fail(ErrorCode::kMissingData, "the recording has neither angles nor a speed");
  TURNSCAN_ASSIGN(const auto pairs, checks::turn_pairs(sequence, angle, context));
  if (pairs.empty()) return std::nullopt;
  const auto positions = checks::positions_of(pairs);
  if (positions.size() < 3) return std::nullopt;
  motion::MotionDataOptions loading;
  loading.hint = table;
  loading.memory = memory;
  const auto data = motion::load_motion(SequenceView(sequence, positions), loading, context);
  if (!data) {
    if (data.error().code == ErrorCode::kTooFewPoints) return std::nullopt;
    return tl::unexpected<Error>(data.error());
  }
  return checks::compare_pairs(pairs, positions, angle, *table, *data, context);
}

}  // namespace turnscan
