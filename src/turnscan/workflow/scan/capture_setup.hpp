#pragma once
// Sensors, turntable and motor of a recording: opened, and described for recording.json.

#include <memory>
#include <optional>
#include <string>
#include <turnscan/capture/session/capture.hpp>
#include <turnscan/recording/recording.hpp>
#include <vector>

namespace turnscan {

/// Speed of a table that is turned by a motor, unless one is given: 10 degrees a second.
inline constexpr double kMotorSpeed_rad_s = 0.17453293;

/// What the source says of its settings, and which devices it consists of.
CaptureSettings settings_of(const SourceInfo& source);

/// That the turntable is the one of a calibration that was made then; empty: not known when.
void note_calibration_date(const std::string& made_at, CaptureSettings& settings);

/// Connects the motor at a serial port and notes its board in the settings. Fails as Motor::open().
Result<Motor> open_motor(const std::string& port, const MotorOptions& options,
                         CaptureSettings& settings, const RunContext& context);

/// With a motor the speed is kMotorSpeed_rad_s unless it is given; the header's turntable, if any,
/// turns with the speed that is given.
void settle_speed(bool with_motor, CaptureOptions& options, SequenceHeader& header);

/// What is to be recorded with, and what opening it found.
struct CaptureSetup {
  std::vector<std::string> devices;  ///< URIs; their frames go into one recording
  std::string turntable_file;        ///< that turnscan calibrate saved; empty: none
  std::string motor_port;            ///< empty: none
  MotorOptions motor;
  CaptureOptions options;

  // Found by open():
  SequenceHeader header;
  CaptureSettings settings;

  /// Opens the sensors, makes header and settings and settles the speed. Fails as open_sources()
  /// and read_calibration(); with kInvalidOption when the file's turntable is of another number of
  /// sensors or another size of images.
  Result<std::unique_ptr<FrameSource>> open(const RunContext& context);
  /// nullopt without a port. Fails as Motor::open().
  Result<std::optional<Motor>> open_motor(const RunContext& context);
  /// Whether the place of every sensor is known, after open().
  bool places_known() const;
};

}  // namespace turnscan
