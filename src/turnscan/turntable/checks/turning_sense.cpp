#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/checks/recorded_angles.hpp>
#include <turnscan/turntable/checks/turning_sense.hpp>
#include <turnscan/turntable/motion/pair_residuals.hpp>

namespace turnscan::checks {

namespace {

/// More frames show no more of the sense, and neighbours that are closer show less.
constexpr std::size_t kMaxSenseFrames = 24, kMinSenseFrames = 3;
/// As for angles about an axis that is not known yet (motion/initialisation.cpp).
constexpr double kClearlyBetter = 1.25;

/// Evenly spaced frames within the first turn.
std::vector<std::size_t> frames_of_first_turn(const std::vector<double>& angle) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    if (!std::isfinite(angle[i])) continue;
    if (!out.empty() && std::abs(angle[i] - angle[out.front()]) >= kTurn) break;
    out.push_back(i);
  }
  return evenly_spread_to_last(std::move(out), kMaxSenseFrames);
}

}  // namespace

}  // namespace turnscan::checks

namespace turnscan {

bool TurningSense::reversed() const {
  return reversed_cost * checks::kClearlyBetter < recorded_cost;
}

Result<std::optional<TurningSense>> measure_turning_sense(const FrameSequence& sequence,
                                                          const RunContext& context) {
  const auto& table = sequence.header().turntable;
  if (!table)
    return fail(ErrorCode::kMissingData, "the recording does not say where the turntable is");
  const auto angle = checks::recorded_angles(sequence);
  const auto positions = checks::frames_of_first_turn(angle);
  if (positions.size() < checks::kMinSenseFrames) return std::nullopt;
  motion::MotionDataOptions loading;
  loading.hint = table;
  loading.use_platter = false;  // what is asked is whether frames fit about the recorded axis
  const auto data = motion::load_motion(SequenceView(sequence, positions), loading, context);
  if (!data) {
    if (data.error().code == ErrorCode::kTooFewPoints) return std::nullopt;
    return tl::unexpected<Error>(data.error());
  }
  motion::MotionState state;
  state.axis = table->axis.normalized();
  state.center = table->center_m;
  for (const std::size_t i : positions) state.angle.push_back(angle[i] - angle[positions[0]]);
  TurningSense out;
  out.recorded_cost = motion::mean_pair_cost(*data, state);
  for (double& turned : state.angle) turned = -turned;
  out.reversed_cost = motion::mean_pair_cost(*data, state);
  return out;
}

SequenceView with_reversed_angles(const FrameSequence& sequence) {
  SequenceView out(sequence);
  SequenceHeader header = sequence.header();
  if (header.turntable && header.turntable->speed_rad_s)
    header.turntable->speed_rad_s = -*header.turntable->speed_rad_s;
  out.set_header(std::move(header));
  std::vector<FrameInfo> frames = sequence.frames();
  for (FrameInfo& frame : frames)
    if (frame.angle_rad) frame.angle_rad = -*frame.angle_rad;
  out.set_frames(std::move(frames));
  return out;
}

}  // namespace turnscan
