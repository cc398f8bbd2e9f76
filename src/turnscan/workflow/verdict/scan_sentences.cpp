#include <turnscan/workflow/verdict/scan_sentences.hpp>

#include <cctype>
#include <turnscan/workflow/calibration/exactness_text.hpp>
#include <turnscan/workflow/verdict/frame_agreement.hpp>

namespace turnscan::workflow {

namespace {

constexpr double kHalfTurn = 0.5;
constexpr double kFewDropped = 0.5;
/// Frames that disagree by more, beyond what their noise explains, blur the mesh.
constexpr double kAgreed_m = 0.001;
/// Share of frames that may be displaced from the others: they are outvoted, since enough others
/// see the same surface.
constexpr double kOutvoted = 0.1;

void add_found(const Calibration& found, Findings& out) {
  const bool open = !found.undetermined.empty();
  out.push_back({"calibration", open ? Level::kFair : Level::kGood,
                 fmt::format("The turntable was found from the motion in this recording: {}.{}",
                             exactness_text(found),
                             open ? fmt::format(" It does not determine {}.",
                                                fmt::join(found.undetermined, ", "))
                                  : ""),
                 found.center_sigma_m * 1e3, "mm"});
}

std::string platter_text(const RigCheck& check) {
  return fmt::format(
      "The platter in it lies {:.1f} mm {}, {:.1f} mm aside and tilted by {:.2f} deg against the "
      "calibration.",
      1e3 * std::abs(check.height_m), check.height_m < 0.0 ? "lower" : "higher",
      1e3 * check.shift_m, check.tilt_rad * kDegreesPerRadian);
}

/// Adds findings on the calibration stored in the recording.
void add_recorded(const ScanKnowledge& known, Findings& out) {
  const auto& offset = known.choice->checks.axis_offset;
  std::vector<std::string> parts;
  if (offset)
    parts.push_back(
        fmt::format("The frames turn about an axis {:.2f} mm and {:.2f} deg from the recorded one "
                    "(known to {:.2f} mm and {:.2f} deg).",
                    offset->shift_m * 1e3, offset->tilt_rad * kDegreesPerRadian,
                    offset->shift_sigma_m * 1e3, offset->tilt_sigma_rad * kDegreesPerRadian));
  parts.push_back(known.platter ? platter_text(*known.platter)
                                : "No platter was seen in it to check the calibration by.");
  parts.push_back(age_text(known.dates));
  // The motion of the object is the more reliable evidence, if available. Where it is not reliable
  // enough and no platter confirms the calibration, nothing does.
  const bool moved = !offset && known.platter && known.platter->moved;
  const bool unconfirmed = offset && offset->visible() && !known.platter;
  const Level level = offset && offset->significant() ? Level::kBad
                      : moved || unconfirmed          ? Level::kFair
                                                      : Level::kGood;
  out.push_back({"calibration", level, fmt::format("{}", fmt::join(parts, " ")),
                 offset ? offset->shift_m * 1e3 : std::nan(""), offset ? "mm" : ""});
}

std::string as_sentence(std::string text) {
  if (!text.empty()) text.front() = char(std::toupper(static_cast<unsigned char>(text.front())));
  return text + ".";
}

std::string compared_text(const FrameAgreement& a) {
  std::string text;
  const auto add = [&](const char* who, const std::optional<double>& apart_m) {
    if (apart_m) text += fmt::format(" {} differ by {:.2f} mm.", who, *apart_m * 1e3);
  };
  add("Neighbouring frames", a.neighbours_m);
  add("Frames a turn apart", a.turn_apart_m);
  add("Sensors", a.sensors_m);
  add("Passes", a.passes_m);
  return text;
}

}  // namespace

bool looked_from_all_sides(const TurnSeen& turn) { return turn.widest_gap_rad <= kSideGap_rad; }

Level level_of(double value, double good, double fair) {
  return value >= good ? Level::kGood : value >= fair ? Level::kFair : Level::kBad;
}

void add_plausibility(const ScanKnowledge& known, Findings& out) {
  for (const PlausibilityFinding& finding : known.findings)
    if (finding.level == Plausibility::kImplausible)
      out.push_back({"plausibility", Level::kBad, as_sentence(finding.text), std::nan(""), ""});
  if (known.choice != nullptr && known.choice->may_be_mirrored)
    out.push_back(
        {"plausibility", Level::kFair,
         "The angles count the wrong way round, or the depth images are mirrored, as some "
         "programs of Kinects record them. The sign of the angles was changed, so in the second "
         "case the mesh is a mirror image.",
         std::nan(""), ""});
}

void add_turn(const ScanKnowledge& known, Findings& out) {
  if (!known.turn) return;
  const TurnSeen& turn = *known.turn;
  const bool whole = turn.share >= kWholeTurn;
  // A gap that leaves every upright side visible only costs the unseen surface, which is counted
  // separately.
  const Level level = whole || looked_from_all_sides(turn) ? Level::kGood
                      : turn.share >= kHalfTurn            ? Level::kFair
                                                           : Level::kBad;
  const double seen_deg = 360.0 * turn.share;
  const std::string text =
      whole ? fmt::format("The frames look from all sides, over {:.2f} turns.", turn.turns)
      : level == Level::kGood
          ? fmt::format("The frames look from all sides, up to {:.0f} degrees apart.",
                        turn.widest_gap_rad * kDegreesPerRadian)
          : fmt::format(
                "The frames look from {:.0f} of 360 degrees. There is no view from the other "
                "{:.0f}.",
                seen_deg, 360.0 - seen_deg);
  out.push_back({"turn", level, text, seen_deg, "deg"});
}

void add_calibration(const ScanKnowledge& known, Findings& out) {
  if (known.choice == nullptr) return;
  const CalibrationChoice& choice = *known.choice;
  if (choice.calibration)
    add_found(*choice.calibration, out);
  else if (known.table_recorded || choice.checks.axis_offset)
    add_recorded(known, out);
  if (const auto& closure = choice.checks.closure; closure && !choice.calibration)
    out.push_back({"closure", closure->significant() ? Level::kBad : Level::kGood,
                   fmt::format("One turn later the object lies {:.2f} mm from where it was; {}.",
                               closure->shift_m * 1e3, closure->noise_text()),
                   closure->shift_m * 1e3, "mm"});
}

void add_disturbances(const ScanKnowledge& known, Findings& out) {
  if (known.choice == nullptr) return;
  const CalibrationChoice& choice = *known.choice;
  const bool moved = !choice.poses.empty() || !choice.left_out.empty();
  const bool follows_slips = choice.calibration && !choice.calibration->slips.empty();
  for (const Disturbance& disturbance : choice.disturbances) {
    const bool corrected = moved || (follows_slips && disturbance.kind == DisturbanceKind::kSlip);
    out.push_back(
        {"disturbance", corrected ? Level::kGood : Level::kBad,
         as_sentence(disturbance.text) + (corrected ? " Its frames were put right or left out."
                                                    : " Nothing was done about it."),
         disturbance.size_m * 1e3, "mm"});
  }
}

void add_agreement(const std::vector<FrameResidual>& residuals, Findings& out) {
  if (residuals.empty()) return;
  const FrameAgreement a = frame_agreement(residuals);
  const bool agree = a.most_m < std::max(kAgreed_m, a.spread_m);
  out.push_back({"agreement", agree ? Level::kGood : Level::kFair,
                 fmt::format("Half of the frames lie within {:.2f} mm of what all of them show, 95 "
                             "% within {:.2f} mm.{}",
                             a.usual_m * 1e3, a.most_m * 1e3, compared_text(a)),
                 a.usual_m * 1e3, "mm"});
  if (a.apart.empty()) return;
  std::size_t count = 0;
  for (const FramesApart& apart : a.apart) count += apart.last - apart.first + 1;
  // A few among many that agree are outvoted; many form a surface of their own.
  const bool many = double(count) > kOutvoted * double(a.frames);
  out.push_back({"apart",
                 many    ? Level::kBad
                 : agree ? Level::kGood
                         : Level::kFair,
                 fmt::format("{} of {} frames lie elsewhere than the rest: {}.", count, a.frames,
                             frames_apart_text(a, residuals)),
                 double(count), "frames"});
}

void add_dropped(const Reconstruction& run, Findings& out) {
  const std::size_t all = run.frames + run.dropped_frames;
  if (run.dropped_frames == 0 || all == 0) return;
  const double share = double(run.dropped_frames) / double(all);
  // What they would have shown is counted as missing in the turn and in the seen surface.
  out.push_back({"frames", share > kFewDropped ? Level::kFair : Level::kGood,
                 fmt::format("{} of {} frames were dropped.", run.dropped_frames, all),
                 100.0 * share, "%"});
}

}  // namespace turnscan::workflow
