#include <turnscan/workflow/scan/capture_setup.hpp>

#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/turntable/table_frame.hpp>

namespace turnscan {

namespace {

Result<> take_turntable(const std::string& file, SequenceHeader& header,
                        CaptureSettings& settings) {
  TURNSCAN_ASSIGN(const Calibration calibration, read_calibration(file));
  if (calibration.others.size() + 1 != header.sensors.size())
    return fail(ErrorCode::kInvalidOption,
                "turntable: {} tells where {} sensor{} stand{}, but there {}; calibrate from a "
                "recording of all of them (turnscan calibrate RECORDING --from-motion --save)",
                file, calibration.others.size() + 1, calibration.others.empty() ? "" : "s",
                calibration.others.empty() ? "s" : "",
                header.sensors.size() == 1 ? std::string("is one")
                                           : fmt::format("are {}", header.sensors.size()));
  header.turntable = calibration.table;
  note_calibration_date(calibration.made_at, settings);
  if (auto fits = correct_sensors(calibration, header.sensors); !fits)
    return fail_at(file, fits.error().code, "{}", fits.error().message);
  header.sensors[0].T_table_sensor.reset();
  for (std::size_t i = 0; i < calibration.others.size(); ++i)
    header.sensors[i + 1].T_table_sensor = calibration.others[i].T_table_sensor;
  return {};
}

}  // namespace

void note_calibration_date(const std::string& made_at, CaptureSettings& settings) {
  if (made_at.empty())
    settings.erase(kTableCalibratedAt);
  else
    settings[kTableCalibratedAt] = made_at;
}

CaptureSettings settings_of(const SourceInfo& source) {
  CaptureSettings settings = source.settings;
  for (std::size_t i = 0; i < source.identities.size(); ++i)
    settings[i == 0 ? std::string("device") : fmt::format("device_{}", i)] = source.identities[i];
  return settings;
}

Result<Motor> open_motor(const std::string& port, const MotorOptions& options,
                         CaptureSettings& settings, const RunContext& context) {
  TURNSCAN_ASSIGN(Motor opened, Motor::open(port, options, context));
  settings["motor"] = opened.board();
  return opened;
}

void settle_speed(bool with_motor, CaptureOptions& options, SequenceHeader& header) {
  if (with_motor && !options.speed_rad_s) options.speed_rad_s = kMotorSpeed_rad_s;
  if (header.turntable && options.speed_rad_s) header.turntable->speed_rad_s = options.speed_rad_s;
}

Result<std::unique_ptr<FrameSource>> CaptureSetup::open(const RunContext& context) {
  context.begin_phase("open device", 0);
  TURNSCAN_ASSIGN(auto source, open_sources(devices, context));
  header = source->info().header;
  header.source = source->info().uri;
  settings = settings_of(source->info());
  if (!turntable_file.empty()) TURNSCAN_TRY(take_turntable(turntable_file, header, settings));
  settle_speed(!motor_port.empty(), options, header);
  return source;
}

bool CaptureSetup::places_known() const {
  for (std::size_t i = 0; i < header.sensors.size(); ++i)
    if (!sensor_pose(header, i)) return false;
  return true;
}

Result<std::optional<Motor>> CaptureSetup::open_motor(const RunContext& context) {
  if (motor_port.empty()) return std::optional<Motor>();
  context.begin_phase("connect motor", 0);
  TURNSCAN_ASSIGN(Motor opened, turnscan::open_motor(motor_port, motor, settings, context));
  return std::optional<Motor>(std::move(opened));
}

}  // namespace turnscan
