#pragma once
// Opens the sensors, turntable and motor of a recording, and describes them for recording.json.

#include <memory>
#include <optional>
#include <string>
#include <turnscan/capture/session/capture.hpp>
#include <turnscan/recording/recording.hpp>
#include <vector>

namespace turnscan {

/// Default speed of a motorised table: 10 degrees per second.
inline constexpr double kMotorSpeed_rad_s = 0.17453293;

/// The source's description of its settings, and its devices.
CaptureSettings settings_of(const SourceInfo& source);

/// Notes that the turntable is that of a calibration made at this date; empty: date not known.
void note_calibration_date(const std::string& made_at, CaptureSettings& settings);

/// Connects to the motor at a serial port and notes its board in the settings. Fails as
/// Motor::open().
Result<Motor> open_motor(const std::string& port, const MotorOptions& options,
                         CaptureSettings& settings, const RunContext& context);

/// With a motor, the speed defaults to kMotorSpeed_rad_s; a given speed is also set for the
/// header's turntable, if any.
void settle_speed(bool with_motor, CaptureOptions& options, SequenceHeader& header);

/// Devices and options of a recording, and what opening them found.
struct CaptureSetup {
  std::vector<std::string> devices;  ///< URIs; all frames go into one recording
  std::string turntable_file;        ///< saved by turnscan calibrate; empty: none
  std::string motor_port;            ///< empty: none
  MotorOptions motor;
  CaptureOptions options;

  // Found by open():
  SequenceHeader header;
  CaptureSettings settings;

  /// Opens the sensors, creates header and settings and determines the speed. Fails as
  /// open_sources() and read_calibration(); with kInvalidOption if the file's turntable is for
  /// another number of sensors or another image size.
  Result<std::unique_ptr<FrameSource>> open(const RunContext& context);
  /// nullopt if there is no port. Fails as Motor::open().
  Result<std::optional<Motor>> open_motor(const RunContext& context);
  /// Whether the poses of all sensors are known, after open().
  bool places_known() const;
};

}  // namespace turnscan
