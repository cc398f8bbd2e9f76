#pragma once
// A turntable that this computer turns, over a serial port. docs/motor.md describes boards and
// protocols.

#include <limits>
#include <memory>
#include <string>
#include <turnscan/core/option_table.hpp>
#include <turnscan/core/run_context.hpp>

namespace turnscan {

enum class MotorProtocol {
  kAuto,      ///< by what the board says when it starts
  kTurnscan,  ///< the text protocol of docs/motor.md
  kGrbl       ///< G-code as GRBL understands it
};

struct MotorOptions {
  MotorProtocol protocol = MotorProtocol::kAuto;
  int baud = 115200;
  double timeout_s = 1.0;         ///< in which each answer must come
  double boot_s = 2.5;            ///< that the board may take to start after the port was opened
  double units_per_turn = 360.0;  ///< G-code: how far the axis goes in one turn of the platter
  double max_speed_rad_s = 1.5707963267948966;
  bool reversed = false;  ///< the board's positive direction is clockwise
};
/// Fields motor-protocol, motor-baud, motor-timeout, motor-boot, motor-units, motor-max-speed,
/// motor-reversed.
OptionTable describe(MotorOptions& options);

enum class MotorState { kIdle, kTurning, kHalted };
std::string_view name_of(MotorState state);

struct MotorStatus {
  MotorState state = MotorState::kIdle;
  double angle_rad = std::numeric_limits<double>::quiet_NaN();  ///< since the board started
};

/// Angles and speeds are signed: counter-clockwise seen from above is positive.
///
/// Whenever a call fails (an answer that is late, garbled or wrong, a table that does not turn or
/// stops by itself, a port that is gone, kCancelled, too) the table is stopped first, and the error
/// says whether the board confirmed that. The destructor stops a table that turns.
class Motor {
 public:
  /// Waits until the board answers. Fails with kNotFound, kNoPermission, kDeviceBusy, kIo,
  /// kDeviceLost when no board that is known answers, kInvalidOption, kCancelled.
  static Result<Motor> open(const std::string& port, const MotorOptions& options,
                            const RunContext& context);
  Motor(Motor&&) noexcept;
  Motor& operator=(Motor&&) noexcept;
  ~Motor();

  /// For people, e.g. "Grbl 1.1h".
  const std::string& board() const;
  /// Turns until stop(). While it turns, watch() must be called at least every second: a board with
  /// the text protocol stops by itself when it hears nothing.
  Result<> spin(double speed_rad_s);
  /// Turns by an angle and waits until the table stands there.
  Result<> rotate(double angle_rad, double speed_rad_s, const RunContext& context);
  /// Succeeds once the table stands.
  Result<> stop();
  Result<MotorStatus> status();
  /// Looks whether the table still turns as it was told to. Asks the board at most every 0.3 s.
  Result<> watch();

 private:
  struct State;
  explicit Motor(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace turnscan
