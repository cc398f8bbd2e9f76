#include "capture_setup.hpp"

#include <turnscan/recording/calibration_file.hpp>
#include <turnscan/turntable/table_frame.hpp>

#include "command_line.hpp"

namespace turnscan::cli {

namespace {

OptionTable describe_speed(CaptureSetup& setup) {
  OptionTable table;
  table.number("speed", setup.options.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
               "Speed of the table: of the motor (then 10deg/s unless it is given), or where turns "
               "are counted. auto: from the frames' angles, the calibration or the motion");
  return table;
}

}  // namespace

void CaptureSetup::declare(CommandLine& line) {
  line.option("--turntable", "FILE.json", turntable_file,
              "Where the turntable stands: a file that turnscan calibrate saved");
  line.option("--motor", "PORT", motor_port,
              "Turn the table by the board at this serial port, e.g. /dev/ttyUSB0 (see "
              "docs/motor.md)");
  line.allow_config();
  line.group("stops", "Stop and go, with --motor", describe(options.stops));
  line.group("recorder", "Recorder", describe(options.recorder));
  line.group("motor", "Motor", describe(motor));
}

void CaptureSetup::declare_table(CommandLine& line) {
  line.group("table", "Turntable", describe_speed(*this));
  line.group("crop", "Crop", describe(options.crop));
}

Result<std::unique_ptr<FrameSource>> CaptureSetup::open(Session& session) {
  session.context().begin_phase("open device", 0);
  TURNSCAN_ASSIGN(auto source, open_sources(devices, session.context()));
  header = source->info().header;
  header.source = source->info().uri;
  settings = source->info().settings;
  for (std::size_t i = 0; i < source->info().identities.size(); ++i)
    settings[i == 0 ? std::string("device") : fmt::format("device_{}", i)] =
        source->info().identities[i];
  if (!turntable_file.empty()) {
    TURNSCAN_ASSIGN(const Calibration calibration, read_calibration(turntable_file));
    if (calibration.others.size() + 1 != header.sensors.size())
      return fail(ErrorCode::kInvalidOption,
                  "turntable: {} tells where {} sensor{} stand{}, but there {}; calibrate from a "
                  "recording of all of them (turnscan calibrate RECORDING --from-motion --save)",
                  turntable_file, calibration.others.size() + 1,
                  calibration.others.empty() ? "" : "s", calibration.others.empty() ? "s" : "",
                  header.sensors.size() == 1 ? std::string("is one")
                                             : fmt::format("are {}", header.sensors.size()));
    header.turntable = calibration.table;
    if (auto fits = correct_sensors(calibration, header.sensors); !fits)
      return fail_at(turntable_file, fits.error().code, "{}", fits.error().message);
    header.sensors[0].T_table_sensor.reset();
    for (std::size_t i = 0; i < calibration.others.size(); ++i)
      header.sensors[i + 1].T_table_sensor = calibration.others[i].T_table_sensor;
  }
  if (!motor_port.empty() && !options.speed_rad_s) options.speed_rad_s = motor_speed_rad_s;
  if (header.turntable && options.speed_rad_s) header.turntable->speed_rad_s = options.speed_rad_s;
  return source;
}

bool CaptureSetup::places_known() const {
  for (std::size_t i = 0; i < header.sensors.size(); ++i)
    if (!sensor_pose(header, i)) return false;
  return true;
}

Result<std::optional<Motor>> CaptureSetup::open_motor(Session& session) {
  if (motor_port.empty()) return std::optional<Motor>();
  session.context().begin_phase("connect motor", 0);
  TURNSCAN_ASSIGN(Motor opened, Motor::open(motor_port, motor, session.context()));
  settings["motor"] = opened.board();
  return std::optional<Motor>(std::move(opened));
}

}  // namespace turnscan::cli
