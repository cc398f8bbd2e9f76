#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/core/spread.hpp>
#include <turnscan/turntable/checks/axis_offset.hpp>
#include <turnscan/turntable/checks/recorded_angles.hpp>
#include <turnscan/turntable/motion/axis_fit.hpp>

namespace turnscan::checks {

namespace {

constexpr std::size_t kMaxFrames = 36, kMinFrames = 4;
constexpr double kMinTurn = kTurn / 8.0;
// Offsets that are visible in a mesh, and those that non-Gaussian noise causes for a correct axis.
constexpr double kLargestShift_m = 0.0015;
constexpr double kLargestTilt = 0.5 * kRadiansPerDegree;
constexpr double kSigmas = 4.0;

/// Evenly spaced frames with a known angle.
std::vector<std::size_t> placed_frames(const std::vector<double>& angle) {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < angle.size(); ++i)
    if (std::isfinite(angle[i])) out.push_back(i);
  return evenly_spread_to_last(std::move(out), kMaxFrames);
}

}  // namespace

}  // namespace turnscan::checks

namespace turnscan {

AxisOffset axis_offset_between(const TurntableInfo& recorded, const TurntableInfo& found,
                               double tilt_sigma_rad, double shift_sigma_m) {
  const Vec3d axis = recorded.axis.normalized();
  const Vec3d off = found.center_m - recorded.center_m;
  AxisOffset out;
  out.tilt_rad = std::atan2(axis.cross(found.axis).norm(), axis.dot(found.axis));
  out.shift_m = (off - off.dot(axis) * axis).norm();
  out.tilt_sigma_rad = tilt_sigma_rad;
  out.shift_sigma_m = shift_sigma_m;
  return out;
}

bool AxisOffset::visible() const {
  return tilt_rad > checks::kLargestTilt || shift_m > checks::kLargestShift_m;
}

bool AxisOffset::significant() const {
  return tilt_rad > std::max(checks::kLargestTilt, checks::kSigmas * tilt_sigma_rad) ||
         shift_m > std::max(checks::kLargestShift_m, checks::kSigmas * shift_sigma_m);
}

Result<std::optional<AxisOffset>> measure_axis_offset(const FrameSequence& sequence,
                                                      const RunContext& context,
                                                      PlatterMemory* memory) {
  const auto& table = sequence.header().turntable;
  if (!table)
    return fail(ErrorCode::kMissingData, "the recording does not say where the turntable is");
  // Profiles of a line scanner do not overlap once the table has turned.
  const auto& sensors = sequence.header().sensors;
  if (sensors.empty() || sensors.front().kind != SensorKind::kDepthCamera) return std::nullopt;
  const auto angle = checks::recorded_angles(sequence);
  const auto positions = checks::placed_frames(angle);
  if (positions.empty())
    return fail(ErrorCode::kMissingData, "the recording has neither angles nor a speed");
  std::vector<double> placed;
  for (const std::size_t i : positions) placed.push_back(angle[i]);
  const auto [least, most] = std::minmax_element(placed.begin(), placed.end());
  if (placed.size() < checks::kMinFrames || *most - *least < checks::kMinTurn) return std::nullopt;
  motion::MotionDataOptions loading;
  loading.hint = table;
  loading.memory = memory;
  const auto data = motion::load_motion(SequenceView(sequence, positions), loading, context);
  const auto nothing_if_unseen = [](const Error& error) -> Result<std::optional<AxisOffset>> {
    if (error.code == ErrorCode::kTooFewPoints || error.code == ErrorCode::kLibrary)
      return std::nullopt;
    return tl::unexpected<Error>(error);
  };
  if (!data) return nothing_if_unseen(data.error());
  const auto fit = motion::fit_axis(*data, *table, placed, context);
  if (!fit) return nothing_if_unseen(fit.error());
  TurntableInfo found;
  found.axis = fit->axis, found.center_m = fit->center_m;
  AxisOffset out = axis_offset_between(*table, found, fit->axis_sigma_rad, fit->center_sigma_m);
  out.frames = positions.size();
  if (!out.significant()) return out;
  TURNSCAN_ASSIGN(const double gain, motion::gain_over_start(*fit, *data, *table, placed, context));
  if (gain < checks::kSigmas * checks::kSigmas) return std::nullopt;
  return out;
}

}  // namespace turnscan
