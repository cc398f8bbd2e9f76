#pragma once
// What turnscan capture and turnscan scan have in common: sensor, turntable, motor.

#include <memory>
#include <optional>
#include <string>
#include <turnscan/capture/capture.hpp>

#include "command.hpp"

namespace turnscan::cli {

class CommandLine;

struct CaptureSetup {
  std::vector<std::string> devices;  ///< their frames go into one recording
  std::string turntable_file;
  std::string motor_port;
  MotorOptions motor;
  CaptureOptions options;
  double motor_speed_rad_s = 0.17453293;  ///< 10 degrees a second, unless a speed is given

  // Found by open():
  SequenceHeader header;
  CaptureSettings settings;

  /// All but --device, limits, speed and crop.
  void declare(CommandLine& line);
  /// Speed and crop, whose names are those of stages in turnscan scan.
  void declare_table(CommandLine& line);
  /// Opens the sensors and makes header and settings.
  Result<std::unique_ptr<FrameSource>> open(Session& session);
  /// Whether it is known of every sensor where it stands.
  bool places_known() const;
  Result<std::optional<Motor>> open_motor(Session& session);
};

}  // namespace turnscan::cli
