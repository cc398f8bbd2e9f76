#pragma once
// The two kinds of boards behind Motor.

#include <turnscan/capture/motor/motor.hpp>
#include <turnscan/capture/motor/serial_port.hpp>

namespace turnscan::motor {

inline constexpr double kSpinAhead_s = 2.0;
inline constexpr double kStopTimeout_s = 5.0;
inline constexpr int kHaltTries = 3;
/// Lines read while waiting for an answer; a board that sends more does not stop sending.
inline constexpr std::size_t kMaxLines = 50;

/// Degrees in the board's own direction.
struct BoardStatus {
  MotorState state = MotorState::kIdle;
  double angle_deg = 0.0;
};

/// A call that fails leaves the table in an unknown state. Calls fail with kDeviceLost (no answer,
/// or port gone) and kIo (the board refused, or said what cannot be understood).
class MotorBoard {
 public:
  virtual ~MotorBoard() = default;
  virtual const std::string& name() const = 0;
  virtual Result<> spin(double deg_per_s) = 0;
  /// Begins to turn; does not wait.
  virtual Result<> move(double deg, double deg_per_s) = 0;
  /// To be called while it spins, more often than once in kSpinAhead_s: else the table stops, so
  /// that it does not turn for ever when this computer is gone.
  virtual Result<> keep_spinning(double /*angle_deg*/) { return {}; }
  /// Gently; succeeds once the table stands.
  virtual Result<> stop() = 0;
  virtual Result<BoardStatus> status() = 0;
  /// At once, whatever the state of the conversation. Succeeds when the board confirmed.
  virtual Result<> halt() = 0;
};

/// The text protocol. Fails with kDeviceLost when no board answers.
Result<std::unique_ptr<MotorBoard>> open_text_board(SerialPort& port, const MotorOptions& options);
/// GRBL; banner: its first line, empty if it said none.
Result<std::unique_ptr<MotorBoard>> open_grbl_board(SerialPort& port, const MotorOptions& options,
                                                    std::string banner);
bool is_grbl_banner(std::string_view line);

/// The angle, unless it is more than a million turns: then a board has lost itself. Fails with kIo.
Result<double> checked_angle(double deg);

/// For messages: what came, printable and not too long.
std::string shown(std::string_view line);

}  // namespace turnscan::motor
