#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/calibration/disturbed_motion.hpp>

namespace turnscan::workflow {

namespace {

constexpr double kMinTurn_rad = 0.4 * kTurn;
constexpr std::size_t kMinFrames = 16;
/// Rough share of a disturbance's size by which it shifts an axis fitted to all frames.
constexpr double kShiftShare = 0.3;

using Positions = std::vector<std::size_t>;

bool moves_rigidly(const Disturbance& d) {
  return d.kind == DisturbanceKind::kObject || d.kind == DisturbanceKind::kSensor;
}

/// The frames of the longest interval, in table angle, between two moves; empty if nothing moved or
/// too few frames remain.
Positions longest_rest(const FrameSequence& recording, const Calibration& found,
                       const Placement& placement) {
  const std::size_t n = found.angles_rad.size();
  Positions borders{0, n};
  for (const Disturbance& d : placement.disturbances)
    if (moves_rigidly(d) && d.first_frame < n) borders.push_back(d.first_frame);
  if (borders.size() == 2) return {};
  std::sort(borders.begin(), borders.end());
  double longest = kMinTurn_rad;
  Positions out;
  for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
    Positions rest;
    for (std::size_t i = borders[k]; i < borders[k + 1]; ++i) {
      const bool left_out =
          std::binary_search(placement.left_out.begin(), placement.left_out.end(), i);
      if (recording.frames()[i].status == FrameStatus::kOk && !left_out) rest.push_back(i);
    }
    if (rest.size() < kMinFrames) continue;
    const double turned = std::abs(found.angles_rad[rest.back()] - found.angles_rad[rest.front()]);
    if (turned > longest) longest = turned, out = std::move(rest);
  }
  return out;
}

/// Extends the calibration of some frames to all of them: outside of these the table turned at its
/// speed, from the time at which it began to turn.
void extend(const FrameSequence& recording, const Positions& rest, const Calibration& before,
            Calibration& found) {
  const auto& frames = recording.frames();
  std::vector<double> angles(frames.size()), sigmas(frames.size(), std::nan(""));
  for (std::size_t k = 0; k < rest.size(); ++k) {
    angles[rest[k]] = found.angles_rad[k];
    sigmas[rest[k]] = found.angle_sigma_rad[k];
  }
  const auto time_of = [&](std::size_t i) {
    return std::max(frames[i].time_s, before.start_s.value_or(frames[i].time_s));
  };
  const auto turned = [&](std::size_t from, std::size_t to) {
    const double seconds = time_of(to) - time_of(from);
    if (found.table.speed_rad_s && std::isfinite(seconds) &&
        frames[from].stretch == frames[to].stretch)
      return *found.table.speed_rad_s * seconds;
    return before.angles_rad[to] - before.angles_rad[from];
  };
  for (TableSlip& slip : found.slips) slip.first_frame = rest[slip.first_frame];
  for (std::size_t& i : found.left_out) i = rest[i];
  found.left_out.insert(found.left_out.end(), before.left_out.begin(), before.left_out.end());
  std::size_t next = 0;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    while (next + 1 < rest.size() && rest[next] < i) ++next;
    if (rest[next] == i) continue;
    const std::size_t edge = rest[next] > i && next > 0 ? rest[next - 1] : rest[next];
    angles[i] = angles[edge] + turned(edge, i);
  }
  const double zero = angles.front();
  for (double& angle : angles) angle -= zero;
  found.angles_rad = std::move(angles);
  found.angle_sigma_rad = std::move(sigmas);
  found.start_s = before.start_s;
}

/// nullopt: the motion of these frames alone gives no better result.
Result<std::optional<Calibration>> calibrated_by(
    const Positions& rest, const FrameSequence& recording, const FromMotionOptions& options,
    const DetectOptions& detect, const Calibration& before, const RunContext& context) {
  const SequenceView view(recording, rest);
  auto found = calibrate_from_motion(view, options, detect, context);
  if (!found) {
    if (found.error().code == ErrorCode::kCancelled) return tl::unexpected<Error>(found.error());
    return std::nullopt;
  }
  if (!found->undetermined.empty() && found->undetermined != before.undetermined)
    return std::nullopt;
  extend(recording, rest, before, *found);
  return std::move(*found);
}

void widen(const Placement& placement, Calibration& found) {
  double size_m = 0.0;
  for (const Disturbance& d : placement.disturbances)
    if (moves_rigidly(d) || d.kind == DisturbanceKind::kWobble) size_m = std::max(size_m, d.size_m);
  if (size_m == 0.0) return;
  const double shift_m = kShiftShare * size_m;
  constexpr double kObjectSize_m = 0.1;
  found.center_sigma_m = std::hypot(found.center_sigma_m, shift_m);
  found.axis_sigma_rad = std::hypot(found.axis_sigma_rad, shift_m / kObjectSize_m);
}

Result<Placement> disturbances_with(const Calibration& found, const FrameSequence& recording,
                                    PlatterMemory* memory, const RunContext& context) {
  TURNSCAN_ASSIGN(const auto calibrated, with_calibration(recording, found));
  return disturbances_of(*calibrated, std::nullopt, memory, context);
}

}  // namespace

void put_slips_first(const Calibration& calibration, const FrameSequence& recording,
                     Placement& placement) {
  std::vector<Disturbance> slips;
  for (const TableSlip& slip : calibration.slips)
    slips.push_back(disturbance_of(slip, calibration, recording));
  placement.disturbances.insert(placement.disturbances.begin(), slips.begin(), slips.end());
}

bool has_poses(const FrameSequence& sequence) {
  const auto& frames = sequence.frames();
  return std::all_of(frames.begin(), frames.end(),
                     [](const FrameInfo& f) { return f.T_table_sensor.has_value(); });
}

Result<Placement> disturbances_of(const FrameSequence& calibrated,
                                  std::optional<double> stated_speed_rad_s, PlatterMemory* memory,
                                  const RunContext& context) {
  if (has_poses(calibrated)) return Placement();
  const auto poses = frame_poses(calibrated.header(), calibrated.frames(), stated_speed_rad_s);
  if (!poses) return Placement();
  TURNSCAN_ASSIGN(auto found,
                  find_disturbances(calibrated, poses->T_table_sensor, context, memory));
  return found ? std::move(*found) : Placement();
}

Result<Placement> settle_disturbances(const FrameSequence& recording,
                                      const FromMotionOptions& options, const DetectOptions& detect,
                                      Calibration& found, PlatterMemory* memory,
                                      const RunContext& context) {
  TURNSCAN_ASSIGN(Placement placement, disturbances_with(found, recording, memory, context));
  const Positions rest = longest_rest(recording, found, placement);
  if (!rest.empty()) {
    TURNSCAN_ASSIGN(auto settled, calibrated_by(rest, recording, options, detect, found, context));
    if (settled) {
      TURNSCAN_ASSIGN(Placement again, disturbances_with(*settled, recording, memory, context));
      found = std::move(*settled);
      put_slips_first(found, recording, again);
      return again;
    }
  }
  widen(placement, found);
  put_slips_first(found, recording, placement);
  return placement;
}

}  // namespace turnscan::workflow
