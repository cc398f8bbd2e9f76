#pragma once
// The two kinds of boards supported by Motor.

#include <turnscan/capture/motor/gcode_dialect.hpp>
#include <turnscan/capture/motor/motor.hpp>
#include <turnscan/capture/motor/serial_port.hpp>

namespace turnscan::motor {

inline constexpr double kSpinAhead_s = 2.0;
inline constexpr double kStopTimeout_s = 5.0;
inline constexpr int kHaltTries = 3;
/// Maximum number of lines read while waiting for an answer; a board that sends more is flooding
/// the port. Marlin lists its settings when it starts: a hundred lines if it levels a bed.
inline constexpr std::size_t kMaxLines = 150;

/// Angle in degrees in the board's own direction.
struct BoardStatus {
  MotorState state = MotorState::kIdle;
  double angle_deg = 0.0;
};

/// A call that fails leaves the table in an unknown state. Calls fail with kDeviceLost (no answer,
/// or port gone) and kIo (the board refused, or its answer cannot be parsed).
class MotorBoard {
 public:
  virtual ~MotorBoard() = default;
  virtual const std::string& name() const = 0;
  virtual Result<> spin(double deg_per_s) = 0;
  /// Starts turning; does not wait.
  virtual Result<> move(double deg, double deg_per_s) = 0;
  /// Must be called while the table spins, more often than once in kSpinAhead_s; otherwise the
  /// table stops, so that it does not turn forever if this computer fails.
  virtual Result<> keep_spinning(double /*angle_deg*/) { return {}; }
  /// Decelerates; succeeds once the table has stopped.
  virtual Result<> stop() = 0;
  virtual Result<BoardStatus> status() = 0;
  /// Stops at once, whatever the state of the communication. Succeeds if the board confirms.
  virtual Result<> halt() = 0;
};

/// Opens a board with the text protocol. Fails with kDeviceLost if no board answers.
Result<std::unique_ptr<MotorBoard>> open_text_board(SerialPort& port, const MotorOptions& options);
/// Opens a board with G-code; banner: its first line, empty if it sent none.
Result<std::unique_ptr<MotorBoard>> open_gcode_board(SerialPort& port, const MotorOptions& options,
                                                     const GcodeDialect& dialect,
                                                     std::string banner);

/// The angle, unless it exceeds a million turns, which means that the board has lost track. Fails
/// with kIo.
Result<double> checked_angle(double deg);

/// The received line for messages, made printable and truncated.
std::string shown(std::string_view line);

}  // namespace turnscan::motor
