#include <turnscan/workflow/calibration/calibration_choice.hpp>

#include <algorithm>
#include <cmath>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/turntable/checks/axis_offset.hpp>
#include <turnscan/turntable/checks/check.hpp>
#include <turnscan/turntable/checks/turning_sense.hpp>
#include <turnscan/turntable/clouds/cloud_convention.hpp>
#include <turnscan/turntable/motion/calibrate_from_motion.hpp>
#include <turnscan/turntable/placement/find_disturbances.hpp>
#include <turnscan/turntable/rotation.hpp>
#include <turnscan/workflow/calibration/disturbed_motion.hpp>
#include <turnscan/workflow/calibration/exactness_text.hpp>
#include <turnscan/workflow/calibration/reduced_frames.hpp>

namespace turnscan {

namespace {

/// A calibration that is itself doubted replaces another one only if its misfit is less than this
/// share of the other's.
constexpr double kClearlyLess = 0.4;

bool undetermined(const Calibration& found, std::string_view what) {
  return std::find(found.undetermined.begin(), found.undetermined.end(), what) !=
         found.undetermined.end();
}

FromMotionOptions motion_options(const CalibrationRequest& request) {
  FromMotionOptions options;
  options.speed_rad_s = request.speed_rad_s;
  return options;
}

Result<Calibration> motion_of(const FrameSequence& sequence, const CalibrationRequest& request,
                              const RunContext& context) {
  return calibrate_from_motion(sequence, motion_options(request), {}, context);
}

Result<> check_determined(const Calibration& found) {
  for (const char* needed : {"axis", "centre"}) {
    if (undetermined(found, needed))
      return fail(
          ErrorCode::kMissingData,
          "the motion does not determine the turntable's {}: {}; record more of a turn, with the "
          "platter in view if there is one",
          needed, workflow::exactness_text(found));
  }
  return {};
}

CalibrationChoice chosen_from_motion(Calibration found, const std::string& why) {
  CalibrationChoice out;
  out.note = fmt::format("{}, so the turntable was found from motion: {}", why,
                         workflow::exactness_text(found));
  if (!found.undetermined.empty())
    out.note += fmt::format("; not determined: {}", fmt::join(found.undetermined, ", "));
  for (const std::string& note : found.notes) out.note += "; " + note;
  out.calibration = std::move(found);
  return out;
}

/// Also nullopt if the recording lacks what is needed for the measurement.
template <class Measure>
Result<std::optional<Measure>> if_measurable(Result<std::optional<Measure>> measured) {
  if (!measured && measured.error().code == ErrorCode::kMissingData) return std::nullopt;
  return measured;
}

Result<CalibrationChecks> check_calibration(const FrameSequence& sequence, PlatterMemory& memory,
                                            const RunContext& context) {
  CalibrationChecks out;
  TURNSCAN_ASSIGN(out.closure, if_measurable(measure_closure(sequence, context, &memory)));
  if (out.closure && out.closure->significant()) return out;
  TURNSCAN_ASSIGN(out.axis_offset, if_measurable(measure_axis_offset(sequence, context, &memory)));
  return out;
}

/// Why the checks contradict the calibration; nullopt: they do not.
std::optional<std::string> doubt_of(const CalibrationChecks& checks) {
  if (checks.closure && checks.closure->significant())
    return fmt::format("with the recording's calibration the object lies {} away after one turn",
                       checks.closure->offset_text());
  if (checks.axis_offset && checks.axis_offset->significant())
    return fmt::format(
        "the recording's axis lies {:.1f} mm beside the one about which the object turns, and "
        "leans by {:.1f} deg",
        checks.axis_offset->shift_m * 1e3, checks.axis_offset->tilt_rad * kDegreesPerRadian);
  return std::nullopt;
}

/// The sequence with angles from a stated speed instead of its own.
SequenceView at_stated_speed(const FrameSequence& sequence, double speed_rad_s) {
  SequenceView out(sequence);
  SequenceHeader header = sequence.header();
  if (header.turntable) header.turntable->speed_rad_s = speed_rad_s;
  out.set_header(std::move(header));
  std::vector<FrameInfo> frames = sequence.frames();
  for (FrameInfo& frame : frames)
    if (std::isfinite(frame.time_s)) frame.angle_rad.reset();
  out.set_frames(std::move(frames));
  return out;
}

/// Checks the calibration as it would be used without changes.
Result<CalibrationChecks> check_as_used(const FrameSequence& sequence,
                                        const CalibrationRequest& request, PlatterMemory& memory,
                                        const RunContext& context) {
  return request.speed_rad_s
             ? check_calibration(at_stated_speed(sequence, *request.speed_rad_s), memory, context)
             : check_calibration(sequence, memory, context);
}

/// Uses what the user stated, and notes any doubt about it.
Result<CalibrationChoice> as_given(const FrameSequence& sequence, const CalibrationRequest& request,
                                   PlatterMemory& memory, const RunContext& context) {
  CalibrationChoice out;
  TURNSCAN_ASSIGN(out.checks, check_as_used(sequence, request, memory, context));
  if (const auto why = doubt_of(out.checks))
    out.note =
        fmt::format("{}; it was used because {} given (--calibration motion estimates another)",
                    *why, request.speed_rad_s ? "the speed was" : "it was");
  return out;
}

std::string text_of(const Placement& placement) {
  std::vector<std::string> texts;
  for (const Disturbance& disturbance : placement.disturbances) texts.push_back(disturbance.text);
  return fmt::format("{}", fmt::join(texts, "; "));
}

bool moves_frames(const Placement& placement) {
  return std::any_of(placement.disturbances.begin(), placement.disturbances.end(),
                     [](const Disturbance& d) { return d.kind != DisturbanceKind::kHidden; });
}

/// Applies corrected poses after disturbances to the choice, and notes the reason.
void correct(Placement placement, CalibrationChoice& choice) {
  if (placement.disturbances.empty()) return;
  std::string text = text_of(placement);
  if (moves_frames(placement)) {
    text += "; the poses of the frames were corrected";
    choice.poses = std::move(placement.T_table_sensor);
  }
  if (!placement.left_out.empty())
    text += fmt::format("; {} frames were left out", placement.left_out.size());
  choice.left_out = std::move(placement.left_out);
  choice.disturbances = std::move(placement.disturbances);
  choice.note = choice.note.empty() ? text : text + "; " + choice.note;
}

/// The recording's own calibration, with a note on disturbances.
Result<CalibrationChoice> as_recorded(const FrameSequence& sequence,
                                      const CalibrationRequest& request, PlatterMemory& memory,
                                      const RunContext& context) {
  CalibrationChoice out;
  TURNSCAN_ASSIGN(const Placement placement,
                  workflow::disturbances_of(sequence, request.speed_rad_s, &memory, context));
  if (!placement.disturbances.empty())
    out.note =
        text_of(placement) + "; nothing was corrected because --calibration recorded was given";
  out.disturbances = placement.disturbances;
  return out;
}

/// The calibration, with the frames' poses corrected after disturbances.
Result<CalibrationChoice> settled(const FrameSequence& sequence, const CalibrationRequest& request,
                                  Calibration found, const std::string& why, PlatterMemory& memory,
                                  const RunContext& context) {
  TURNSCAN_TRY(check_determined(found));
  TURNSCAN_ASSIGN(auto placement, workflow::settle_disturbances(sequence, motion_options(request),
                                                                {}, found, &memory, context));
  CalibrationChoice out = chosen_from_motion(std::move(found), why);
  correct(std::move(placement), out);
  return out;
}

Result<CalibrationChoice> from_motion(const FrameSequence& sequence,
                                      const CalibrationRequest& request, const std::string& why,
                                      PlatterMemory& memory, const RunContext& context) {
  TURNSCAN_ASSIGN(Calibration found, motion_of(sequence, request, context));
  return settled(sequence, request, std::move(found), why, memory, context);
}

/// The recording's table with the rotation found from motion. Its standard deviations are not
/// known.
Calibration with_recorded_table(const TurntableInfo& table, const Calibration& found) {
  Calibration out;
  out.method = found.method;
  out.table = table;
  out.table.speed_rad_s = found.table.speed_rad_s;
  if (!table.radius_m) out.table.reach_m = found.table.reach_m;
  out.axis_found = out.center_found = out.height_found = "the recording's";
  if (table.radius_m) out.radius_found = "the recording's";
  out.speed_sigma_rad_s = found.speed_sigma_rad_s;
  out.speed_found = found.speed_found, out.angles_found = found.angles_found;
  out.angles_rad = found.angles_rad, out.angle_sigma_rad = found.angle_sigma_rad;
  out.slips = found.slips;
  out.left_out = found.left_out;
  out.start_s = found.start_s;
  return out;
}

/// For a recording with a known table but unknown rotation; nullopt if the rotation cannot be found
/// from motion either, or if the checks then contradict the table.
Result<std::optional<CalibrationChoice>> turned_as_seen(const FrameSequence& sequence,
                                                        const Calibration& found,
                                                        PlatterMemory& memory,
                                                        const RunContext& context) {
  const auto& table = sequence.header().turntable;
  // The poses of further sensors were determined relative to the table found from motion.
  if (!table || undetermined(found, "angles") || !found.others.empty() ||
      table->axis.normalized().dot(found.table.axis) < 0.9)
    return std::nullopt;
  CalibrationChoice out;
  out.calibration = with_recorded_table(*table, found);
  TURNSCAN_ASSIGN(const auto calibrated, with_calibration(sequence, *out.calibration));
  TURNSCAN_ASSIGN(const auto checks, check_calibration(*calibrated, memory, context));
  if (doubt_of(checks)) return std::nullopt;
  out.note = "the recording does not say how its table turned, so that was found from motion";
  if (const auto speed = found.table.speed_rad_s)
    out.note += fmt::format(": {:.2f} deg/s", *speed * kDegreesPerRadian);
  if (!found.left_out.empty())
    for (const std::string& note : found.notes) out.note += "; " + note;
  return out;
}

/// For a recording without a table, or without its rotation.
Result<CalibrationChoice> completed(const FrameSequence& sequence,
                                    const CalibrationRequest& request, PlatterMemory& memory,
                                    const RunContext& context) {
  TURNSCAN_ASSIGN(Calibration found, motion_of(sequence, request, context));
  TURNSCAN_ASSIGN(auto turned, turned_as_seen(sequence, found, memory, context));
  if (!turned)
    return settled(sequence, request, std::move(found), "the recording has no calibration", memory,
                   context);
  TURNSCAN_ASSIGN(const auto calibrated, with_calibration(sequence, *turned->calibration));
  TURNSCAN_ASSIGN(auto placement,
                  workflow::disturbances_of(*calibrated, std::nullopt, &memory, context));
  workflow::put_slips_first(*turned->calibration, sequence, placement);
  correct(std::move(placement), *turned);
  return std::move(*turned);
}

/// The check compares a few frames and states how well they fit; the whole motion also knows how
/// well the shape determines the axis. If that leaves room for the recorded axis, it is kept.
bool leaves_room(const Calibration& found, const TurntableInfo& recorded, CalibrationChoice& kept) {
  const AxisOffset offset =
      axis_offset_between(recorded, found.table, found.axis_sigma_rad, found.center_sigma_m);
  if (kept.checks.closure && kept.checks.closure->significant()) return false;
  if (offset.significant()) return false;
  kept.checks.axis_offset = offset;
  kept.note = fmt::format(
      "the motion puts the axis {:.1f} mm beside the recorded one, but determines it to {:.1f} mm "
      "only, so the recorded one was kept",
      offset.shift_m * 1e3, offset.shift_sigma_m * 1e3);
  return true;
}

/// The recording's own calibration, or one from motion if the checks contradict it.
Result<CalibrationChoice> undoubted(const FrameSequence& sequence,
                                    const CalibrationRequest& request, PlatterMemory& memory,
                                    const RunContext& context) {
  if (request.table_given || request.speed_rad_s)
    return as_given(sequence, request, memory, context);
  CalibrationChoice out;
  TURNSCAN_ASSIGN(out.checks, check_calibration(sequence, memory, context));
  const auto why = doubt_of(out.checks);
  if (!why) return out;
  auto found = from_motion(sequence, request, *why, memory, context);
  if (!found && found.error().code == ErrorCode::kCancelled) return found;
  std::string failure = found ? "" : found.error().message;
  if (found && found->poses.empty() &&
      leaves_room(*found->calibration, *sequence.header().turntable, out))
    return out;
  if (found) {
    // A calibration replaces the recording's only if the checks do not contradict it.
    TURNSCAN_ASSIGN(const auto better, with_calibration(sequence, *found->calibration));
    TURNSCAN_ASSIGN(const auto checks, check_calibration(*better, memory, context));
    if (!doubt_of(checks) || !found->poses.empty()) return found;
    if (checks.misfit_m() < kClearlyLess * out.checks.misfit_m()) {
      found->note += "; it fits better than the recorded one, but not well";
      return found;
    }
    failure = "the one from motion does not fit either";
  }
  out.note = fmt::format("{}, but no better one was found ({})", *why, failure);
  return out;
}

Result<CalibrationChoice> automatic(const FrameSequence& sequence,
                                    const CalibrationRequest& request, PlatterMemory& memory,
                                    const RunContext& context) {
  if (workflow::has_poses(sequence)) return CalibrationChoice();  // these are not questioned
  const auto poses = frame_poses(sequence.header(), sequence.frames(), request.speed_rad_s);
  if (!poses) {
    auto found = completed(sequence, request, memory, context);
    if (found || found.error().code == ErrorCode::kCancelled ||
        found.error().code == ErrorCode::kInvalidOption)
      return found;
    return fail(ErrorCode::kMissingData, "{} (and from motion: {})", poses.error().message,
                found.error().message);
  }
  TURNSCAN_ASSIGN(Placement placement,
                  workflow::disturbances_of(sequence, request.speed_rad_s, &memory, context));
  CalibrationChoice out;
  if (!moves_frames(placement)) {
    TURNSCAN_ASSIGN(out, undoubted(sequence, request, memory, context));
    if (!out.left_out.empty()) return out;  // found with the better calibration
  }
  correct(std::move(placement), out);
  return out;
}

/// Keeps the recording's own calibration if coarse frames, which cost less, show no contradiction
/// and no disturbance. nullopt: check again with finer ones.
Result<std::optional<CalibrationChoice>> if_sound(const FrameSequence& coarse,
                                                  const CalibrationRequest& request,
                                                  const RunContext& context) {
  if (workflow::has_poses(coarse) ||
      !frame_poses(coarse.header(), coarse.frames(), request.speed_rad_s))
    return std::nullopt;
  PlatterMemory memory;
  TURNSCAN_ASSIGN(const Placement placement,
                  workflow::disturbances_of(coarse, request.speed_rad_s, &memory, context));
  if (!placement.disturbances.empty()) return std::nullopt;
  CalibrationChoice out;
  TURNSCAN_ASSIGN(out.checks, check_as_used(coarse, request, memory, context));
  if (doubt_of(out.checks)) return std::nullopt;
  out.platter = memory.platter;
  return out;
}

Result<CalibrationChoice> by_mode(const FrameSequence& sequence, const CalibrationRequest& request,
                                  PlatterMemory& memory, const RunContext& context) {
  if (request.mode == "recorded") return as_recorded(sequence, request, memory, context);
  if (request.mode == "motion")
    return from_motion(sequence, request, "--calibration motion was given", memory, context);
  if (request.mode == "auto") return automatic(sequence, request, memory, context);
  return fail(ErrorCode::kInvalidOption,
              "--calibration {}: there is no such way; use auto, recorded or motion", request.mode);
}

/// For angles of the right sense.
Result<CalibrationChoice> choose_forwards(const FrameSequence& sequence,
                                          const CalibrationRequest& request,
                                          const RunContext& context) {
  if (request.mode == "auto" && workflow::are_coarser_for_checks(sequence.header())) {
    const SequenceView coarse = workflow::reduced_frames(sequence, workflow::kPixelsToCheck);
    TURNSCAN_ASSIGN(auto sound, if_sound(coarse, request, context));
    if (sound) return std::move(*sound);
  }
  const SequenceView reduced = workflow::reduced_frames(sequence);
  PlatterMemory memory;  // the platter's position does not depend on which check asks for it
  TURNSCAN_ASSIGN(CalibrationChoice out, by_mode(reduced, request, memory, context));
  out.platter = memory.platter;
  return out;
}

/// Whether the angles of a recording with a turntable count in the wrong sense.
Result<bool> counts_backwards(const FrameSequence& sequence, const CalibrationRequest& request,
                              const RunContext& context) {
  if (request.speed_rad_s || !sequence.header().turntable || workflow::has_poses(sequence) ||
      !frame_poses(sequence.header(), sequence.frames(), std::nullopt))
    return false;
  TURNSCAN_ASSIGN(const auto sense,
                  if_measurable(measure_turning_sense(
                      workflow::reduced_frames(sequence, workflow::kPixelsToCheck), context)));
  return sense && sense->reversed();
}

/// The choice for angles of the opposite sign.
Result<CalibrationChoice> with_sense_corrected(const FrameSequence& sequence,
                                               const CalibrationRequest& request,
                                               const RunContext& context) {
  const SequenceView reversed = with_reversed_angles(sequence);
  TURNSCAN_ASSIGN(CalibrationChoice out, choose_forwards(reversed, request, context));
  if (!out.calibration) {
    Calibration& turned = out.calibration.emplace();
    turned.method = CalibrationMethod::kMotion;
    turned.table = *reversed.header().turntable;
    turned.axis_found = turned.center_found = turned.height_found = "the recording's";
    turned.angles_found = "the recording's, with the opposite sign";
    for (const FrameInfo& frame : reversed.frames())
      if (frame.angle_rad) turned.angles_rad.push_back(*frame.angle_rad);
    if (turned.angles_rad.size() != reversed.frames().size()) turned.angles_rad.clear();
  }
  const std::string note =
      "the recorded angles count the wrong way round: the frames fit about the recorded axis when "
      "their sign is changed, so it was";
  out.note = out.note.empty() ? note : note + "; " + out.note;
  return out;
}

/// Whether the object turns against the angles, or the speed, that are recorded.
bool turns_against(const FrameSequence& recorded, const Calibration& found) {
  const auto& frames = recorded.frames();
  const auto& table = recorded.header().turntable;
  double along = 0.0;
  for (std::size_t i = 0; i < found.angles_rad.size(); ++i)
    if (frames[i].angle_rad && frames[0].angle_rad)
      along += (*frames[i].angle_rad - *frames[0].angle_rad) *
               (found.angles_rad[i] - found.angles_rad[0]);
  if (along == 0.0 && table && table->speed_rad_s && found.table.speed_rad_s)
    along = *table->speed_rad_s * *found.table.speed_rad_s;
  return along < 0.0;
}

}  // namespace

double CalibrationChecks::misfit_m() const {
  constexpr double kArm_m = 0.1;
  double out = 0.0;
  // The rotation of a round object cannot be observed.
  if (closure)
    out = std::hypot(closure->shift_m,
                     std::isfinite(closure->turn_rad) ? kArm_m * closure->turn_rad : 0.0);
  if (axis_offset)
    out = std::max(out, std::hypot(axis_offset->shift_m, kArm_m * axis_offset->tilt_rad));
  return out;
}

Result<CalibrationChoice> choose_calibration(const FrameSequence& sequence,
                                             const CalibrationRequest& request,
                                             const RunContext& context) {
  if (request.mode != "auto") return choose_forwards(sequence, request, context);
  const SensorInfo& sensor = sequence.header().sensors.front();
  const auto& table = sequence.header().turntable;
  const bool stated = table && !workflow::has_poses(sequence);
  if (stated)
    TURNSCAN_TRY(motion::check_handedness(sensor, table->axis, table->center_m,
                                          table->radius_m.value_or(0.0)));
  TURNSCAN_ASSIGN(const bool backwards, counts_backwards(sequence, request, context));
  TURNSCAN_ASSIGN(CalibrationChoice out, backwards
                                             ? with_sense_corrected(sequence, request, context)
                                             : choose_forwards(sequence, request, context));
  out.may_be_mirrored = sensor.kind == SensorKind::kDepthCamera && out.calibration &&
                        turns_against(sequence, *out.calibration);
  if (stated && sensor.kind == SensorKind::kPointScanner) {
    std::string note =
        motion::convention_text(table->axis, sensor.viewpoint.direction_from(table->center_m));
    out.note = out.note.empty() ? std::move(note) : note + "; " + out.note;
  }
  return out;
}

Result<std::unique_ptr<FrameSequence>> with_choice(const FrameSequence& sequence,
                                                   const CalibrationChoice& choice) {
  auto out = std::make_unique<SequenceView>(sequence);
  std::vector<FrameInfo> frames = sequence.frames();
  if (choice.calibration) {
    if (choice.poses.empty() && choice.left_out.empty())
      return with_calibration(sequence, *choice.calibration);
    TURNSCAN_ASSIGN(const auto calibrated, with_calibration(sequence, *choice.calibration));
    out->set_header(calibrated->header());
    frames = calibrated->frames();
  }
  for (std::size_t i = 0; i < choice.poses.size(); ++i) frames[i].T_table_sensor = choice.poses[i];
  for (const std::size_t i : choice.left_out) frames[i].status = FrameStatus::kDropped;
  out->set_frames(std::move(frames));
  return out;
}

}  // namespace turnscan
