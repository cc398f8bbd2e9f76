#include <turnscan/workflow/scan/table_finder.hpp>

#include <turnscan/capture/session/device_calibration.hpp>
#include <turnscan/capture/session/table_watch.hpp>
#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/turntable/checks/check.hpp>
#include <turnscan/turntable/detection/detect.hpp>

namespace turnscan::workflow {

namespace {

constexpr int kDetectFrames = 20;

/// Whether the error means that nothing was detected, rather than a failure.
bool nothing_seen(const Error& error) {
  return error.code == ErrorCode::kMissingData || error.code == ErrorCode::kTooFewPoints ||
         error.code == ErrorCode::kUnsupported;
}

/// The table in the frame of a sensor with this pose.
TurntableInfo table_seen_from(const Pose& T_table_sensor) {
  TurntableInfo table;
  table.axis = T_table_sensor.linear().transpose() * Vec3d::UnitY();
  table.center_m = T_table_sensor.inverse() * Vec3d::Zero();
  return table;
}

}  // namespace

Result<bool> TableFinder::find(FrameSource& source, const RunContext& context) {
  const bool stated = setup_.header.turntable && setup_.places_known();
  if (stated && setup_.turntable_file.empty()) return true;
  if (!stated && setup_.devices.size() > 1) {
    // A platter determines each sensor's pose relative to it, but not the azimuths between sensors.
    notes_.push_back("the poses of the sensors are estimated from the object's motion alone");
    return false;
  }
  context.begin_phase("look for the turntable", 0);
  const auto scan = mean_of_next(source, 0, kDetectFrames, context);
  if (!scan && !nothing_seen(scan.error())) return tl::unexpected<Error>(scan.error());
  if (!scan) return stated;  // nothing visible yet
  if (stated) {
    TURNSCAN_TRY(check_stated(source, *scan, context));
    return true;
  }
  TURNSCAN_ASSIGN(const bool kept, take_kept(source, *scan, context));
  if (kept) return true;
  TURNSCAN_TRY(detect(source, *scan, context));
  return false;
}

Result<> TableFinder::detect(const FrameSource& source, const AveragedScan& scan,
                             const RunContext& context) {
  const auto platter = detect_platter(scan, DetectOptions(), context);
  if (!platter && !nothing_seen(platter.error())) return tl::unexpected<Error>(platter.error());
  if (!platter) {
    notes_.push_back("the platter was not found (" + platter.error().message +
                     "), so the turntable is estimated from the object's motion alone");
    return {};
  }
  set_table(calibration_of(*platter, scan).table, date_of_calibration(source.info()));
  notes_.push_back(fmt::format("the turntable was found by its platter, {:.0f} mm in radius",
                               setup_.header.turntable->radius_m.value_or(0.0) * 1e3));
  return {};
}

/// A speed from an earlier day does not apply now.
void TableFinder::set_table(const TurntableInfo& table, const std::string& made_at) {
  note_calibration_date(made_at, setup_.settings);
  setup_.header.turntable = table;
  setup_.header.turntable->speed_rad_s = setup_.options.speed_rad_s;
}

Result<> TableFinder::check_stated(FrameSource& source, const AveragedScan& first,
                                   const RunContext& context) const {
  TURNSCAN_ASSIGN(const Calibration stated, read_calibration(setup_.turntable_file));
  TURNSCAN_TRY(check_sensor(first, stated, "", context));
  for (std::size_t k = 0; k < stated.others.size(); ++k) {
    TURNSCAN_ASSIGN(const AveragedScan scan,
                    mean_of_next(source, std::uint32_t(k + 1), kDetectFrames, context));
    Calibration calibration;
    calibration.table = table_seen_from(stated.others[k].T_table_sensor);
    calibration.table.radius_m = stated.table.radius_m;
    TURNSCAN_TRY(check_sensor(scan, calibration, fmt::format("sensor {}: ", k + 1), context));
  }
  return {};
}

Result<> TableFinder::check_sensor(const AveragedScan& scan, const Calibration& calibration,
                                   const std::string& who, const RunContext& context) const {
  TURNSCAN_ASSIGN(const RigCheck check, check_rig(scan, calibration, context));
  if (!check.moved) return {};
  return fail_at(setup_.turntable_file, ErrorCode::kMissingData,
                 "{}{}; calibrate anew, or leave out --turntable", who, check.text);
}

Result<bool> TableFinder::take_kept(const FrameSource& source, const AveragedScan& scan,
                                    const RunContext& context) {
  const auto& identities = source.info().identities;
  if (identities.empty()) return false;
  const auto kept = kept_calibration(identities.front());
  // Without a home there is no stored calibration.
  if (!kept && kept.error().code != ErrorCode::kNotFound)
    notes_.push_back("the stored calibration of this device is not used: " + kept.error().text());
  if (!kept || !*kept) return false;
  TURNSCAN_ASSIGN(const RigCheck check, check_rig(scan, **kept, context));
  notes_.push_back(check.text);
  if (check.moved) return false;
  set_table((*kept)->table, (*kept)->made_at);
  TURNSCAN_TRY(correct_sensors(**kept, setup_.header.sensors));
  notes_.push_back("the turntable's pose is that of the stored calibration of this device");
  return true;
}

}  // namespace turnscan::workflow
