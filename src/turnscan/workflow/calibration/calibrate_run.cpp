#include <turnscan/workflow/calibration/calibrate_run.hpp>

#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/turntable/detection/picked_points.hpp>

#include <turnscan/workflow/calibration/calibration_age.hpp>
#include <turnscan/workflow/calibration/disturbed_motion.hpp>
#include <turnscan/workflow/calibration/pick_file.hpp>
#include <turnscan/workflow/calibration/sensor_correction.hpp>

namespace turnscan {

namespace {

/// Calibrates from motion, and notes what disturbed the recording.
Result<Calibration> motion_calibration(const FrameSequence& recording,
                                       const CalibrateRequest& request, const RunContext& context) {
  TURNSCAN_ASSIGN(Calibration out,
                  calibrate_from_motion(recording, request.motion, request.detect, context));
  TURNSCAN_ASSIGN(const Placement placement,
                  workflow::settle_disturbances(recording, request.motion, request.detect, out,
                                                nullptr, context));
  for (const Disturbance& disturbance : placement.disturbances)
    out.notes.push_back(disturbance.text);
  return out;
}

Result<Calibration> platter_calibration(const FrameSequence& recording,
                                        const CalibrateRequest& request,
                                        const RunContext& context) {
  TURNSCAN_ASSIGN(const AveragedScan scan,
                  workflow::average_sensor(recording, 0, request.average, context));
  TURNSCAN_ASSIGN(const DetectedPlatter platter, detect_platter(scan, request.detect, context));
  Calibration out = calibration_of(platter, scan);
  out.table.speed_rad_s = request.motion.speed_rad_s;
  if (request.motion.speed_rad_s) out.speed_found = "stated";
  return out;
}

/// From motion; if nothing turns or the rotation cannot be observed, from the platter.
Result<Calibration> by_any_way(const FrameSequence& recording, const CalibrateRequest& request,
                               const RunContext& context) {
  auto moving = motion_calibration(recording, request, context);
  if (moving || moving.error().code == ErrorCode::kCancelled) return moving;
  auto still = platter_calibration(recording, request, context);
  if (!still) {
    if (still.error().code == ErrorCode::kCancelled) return still;
    return fail(ErrorCode::kMissingData,
                "no calibration was found from motion ({}) or from the platter ({})",
                moving.error().message, still.error().message);
  }
  still->notes.push_back("calibration from motion failed: " + moving.error().message);
  return still;
}

Result<Calibration> picked_calibration(const FrameSequence& recording,
                                       const CalibrateRequest& request, const RunContext& context) {
  TURNSCAN_ASSIGN(const bool pixels, workflow::picks_pixels(request.points));
  std::optional<AveragedScan> scan;
  if (pixels) {
    TURNSCAN_ASSIGN(scan, workflow::average_sensor(recording, 0, request.average, context));
  }
  TURNSCAN_ASSIGN(const auto picks, workflow::read_picks(request.points, scan ? &*scan : nullptr));
  const SensorInfo& sensor = recording.header().sensors.front();
  const Vec3d above =
      sensor.viewpoint.parallel ? Vec3d(1e6 * sensor.viewpoint.value) : sensor.viewpoint.value;
  auto calibration = calibrate_from_points(picks, above);
  if (!calibration) {
    // Invalid content of the file is a data error, not a usage error.
    Error error = std::move(calibration).error();
    if (error.code == ErrorCode::kInvalidOption) error.code = ErrorCode::kFormat;
    error.path = request.points;
    return tl::unexpected<Error>(std::move(error));
  }
  return calibration;
}

Result<Calibration> calibrate(const FrameSequence& recording, const CalibrateRequest& request,
                              const RunContext& context) {
  switch (request.way) {
    case CalibrationWay::kPoints:
      return picked_calibration(recording, request, context);
    case CalibrationWay::kMotion:
      return motion_calibration(recording, request, context);
    case CalibrationWay::kPlatter:
      return platter_calibration(recording, request, context);
    case CalibrationWay::kAuto:
      break;
  }
  return by_any_way(recording, request, context);
}

}  // namespace

Result<CalibrationWay> calibration_way(bool points, bool detect, bool from_motion) {
  if (int(points) + int(detect) + int(from_motion) > 1)
    return fail(ErrorCode::kInvalidOption,
                "--points, --detect and --from-motion are different ways to calibrate; give one "
                "of them");
  if (points) return CalibrationWay::kPoints;
  if (from_motion) return CalibrationWay::kMotion;
  return detect ? CalibrationWay::kPlatter : CalibrationWay::kAuto;
}

Result<> CalibrateRequest::check() const {
  if (!depth_also.empty() && !depth_bias)
    return fail(ErrorCode::kInvalidOption, "--depth-also refines --depth-bias; give both");
  if (depth_bias && !detect.radius_m && !ball.diameter_m)
    return fail(ErrorCode::kInvalidOption,
                "--depth-bias needs a known size; give --platter-radius or --gauge-ball");
  if (ball.diameter_m && !depth_bias)
    return fail(ErrorCode::kInvalidOption, "--gauge-ball is for --depth-bias; give both");
  return {};
}

Result<Calibration> run_calibration(const FrameSequence& sequence, const CalibrateRequest& request,
                                    const RunContext& context) {
  TURNSCAN_TRY(request.check());
  TURNSCAN_ASSIGN(const Calibration correction,
                  workflow::sensor_correction(sequence, request, context));
  TURNSCAN_ASSIGN(const auto corrected, workflow::corrected_sequence(sequence, correction));
  TURNSCAN_ASSIGN(Calibration found, calibrate(corrected, request, context));
  workflow::keep_corrections(correction, found);
  found.made_at =
      request.made_at.empty() ? workflow::dates_of(sequence).started_at : request.made_at;
  // Returns the calibration as it is read back from its file.
  TURNSCAN_ASSIGN(Calibration calibration, parse_calibration(calibration_json(found)));
  TURNSCAN_TRY(context.check());
  return calibration;
}

}  // namespace turnscan
