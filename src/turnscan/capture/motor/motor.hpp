#pragma once
// A turntable driven by this computer over a serial port or a network. docs/reference/motor.md
// describes boards and protocols.

#include <limits>
#include <memory>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

enum class MotorProtocol {
  kAuto,      ///< detected from the board's greeting
  kTurnscan,  ///< the text protocol of docs/reference/motor.md
  kGrbl,      ///< G-code, in the dialect of GRBL or ...
  kGrblHal,
  kFluidNc,
  kMarlin
};

struct MotorOptions {
  MotorProtocol protocol = MotorProtocol::kAuto;
  int baud = 115200;
  double timeout_s = 1.0;         ///< for each answer
  double boot_s = 2.5;            ///< time for the board to start after the port was opened
  double units_per_turn = 360.0;  ///< G-code: axis travel per turn of the platter
  double max_speed_rad_s = 1.5707963267948966;
  bool reversed = false;  ///< the board's positive direction is clockwise
};
/// Options motor-protocol, motor-baud, motor-timeout, motor-boot, motor-units, motor-max-speed,
/// motor-reversed.
OptionTable describe(MotorOptions& options);

enum class MotorState { kIdle, kTurning, kHalted };
std::string_view name_of(MotorState state);

struct MotorStatus {
  MotorState state = MotorState::kIdle;
  /// Since the connection was made.
  double angle_rad = std::numeric_limits<double>::quiet_NaN();
  /// As the board counts, which may have been started before this connection.
  double board_rad = std::numeric_limits<double>::quiet_NaN();
};

/// A connected motor. Angles and speeds are signed: counter-clockwise seen from above is positive.
///
/// If a call fails (an answer is late, garbled or wrong, the table does not turn or stops by
/// itself, the port is gone; also kCancelled), the table is stopped first, and the error says
/// whether the board confirmed that. The destructor stops a turning table.
class Motor {
 public:
  /// Connects and waits until the board answers. port: of a serial port the name, of a board in the
  /// network "tcp:HOST:PORT". Fails with kNotFound, kNoPermission, kDeviceBusy,
  /// kIo, kDeviceLost if no known board answers, kInvalidOption, kCancelled.
  static Result<Motor> open(const std::string& port, const MotorOptions& options,
                            const RunContext& context);
  Motor(Motor&&) noexcept;
  Motor& operator=(Motor&&) noexcept;
  ~Motor();

  /// Human-readable name, e.g. "Grbl 1.1h".
  const std::string& board() const;
  /// Turns until stop(). Meanwhile watch() must be called at least every second: a board with the
  /// text protocol stops by itself when it receives nothing.
  Result<> spin(double speed_rad_s);
  /// Turns by an angle and waits until the table has stopped there.
  Result<> rotate(double angle_rad, double speed_rad_s, const RunContext& context);
  /// Succeeds once the table has stopped.
  Result<> stop();
  Result<MotorStatus> status();
  /// Checks that the table still turns as commanded. Queries the board at most every 0.3 s.
  Result<> watch();

 private:
  struct State;
  explicit Motor(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace turnscan
