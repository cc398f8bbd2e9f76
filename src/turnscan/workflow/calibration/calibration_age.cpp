#include <turnscan/workflow/calibration/calibration_age.hpp>

#include <cmath>
#include <turnscan/core/utc_time.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/recording/recording.hpp>
#include <turnscan/turntable/detection/average.hpp>
#include <turnscan/workflow/calibration/reduced_frames.hpp>

namespace turnscan::workflow {

namespace {

constexpr std::size_t kFrames = 12;
constexpr std::size_t kDateLength = 10;  ///< of 2026-08-01

std::string date_in(const CaptureSettings& settings, const char* key) {
  const auto found = settings.find(key);
  return found != settings.end() && utc_seconds(found->second) ? found->second : "";
}

}  // namespace

ScanDates dates_of(const FrameSequence& sequence) {
  const auto* recording = dynamic_cast<const Recording*>(&sequence);
  if (recording == nullptr) return {};
  const CaptureSettings& settings = recording->capture_settings();
  return {date_in(settings, kStartedAt), date_in(settings, kTableCalibratedAt)};
}

ScanDates dates_of(const FrameSequence& sequence, const std::string& turntable_file) {
  ScanDates dates = dates_of(sequence);
  if (turntable_file.empty()) return dates;
  const auto calibration = read_calibration(turntable_file);
  dates.calibrated_at = calibration ? calibration->made_at : "";
  return dates;
}

std::string age_text(const ScanDates& dates) {
  const auto made = utc_seconds(dates.calibrated_at), started = utc_seconds(dates.started_at);
  if (!made) return "When the calibration was made is not known.";
  const std::string day = dates.calibrated_at.substr(0, kDateLength);
  if (!started)
    return fmt::format("The calibration was made on {}. When this was recorded is not known.", day);
  const double age = double(*started - *made);
  if (age < 0.0)
    return fmt::format("The calibration was made {} after this recording ({}).",
                       duration_text(-age), day);
  return fmt::format("The calibration was made {} before this recording ({}).", duration_text(age),
                     day);
}

Result<std::optional<RigCheck>> platter_against_calibration(
    const FrameSequence& sequence, const std::optional<DetectedPlatter>& seen,
    const RunContext& context) {
  const SequenceView reduced = reduced_frames(sequence, kPixelsToCheck);
  const SequenceHeader& header = reduced.header();
  if (!header.turntable || header.sensors.empty() ||
      header.sensors[0].kind != SensorKind::kDepthCamera)
    return std::nullopt;
  Calibration calibration;
  calibration.table = *header.turntable;
  if (seen) {
    const RigCheck check = compare_platter(*seen, calibration);
    // Found without the calibrated radius, it may be another disc.
    if (!check.moved) return check;
  }
  const auto scan =
      average_frames(reduced, spread_positions(reduced, 0, kFrames), AverageOptions(), context);
  const auto check =
      scan ? check_rig(*scan, calibration, context) : tl::unexpected<Error>(scan.error());
  if (!check) {
    if (check.error().code == ErrorCode::kCancelled) return tl::unexpected<Error>(check.error());
    return std::nullopt;
  }
  // Without the rim, the surface at that height may as well be the object's base.
  if (!std::isfinite(check->tilt_rad)) return std::nullopt;
  return *check;
}

}  // namespace turnscan::workflow
