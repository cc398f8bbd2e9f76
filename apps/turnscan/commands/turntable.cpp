#include <chrono>
#include <numbers>
#include <thread>
#include <turnscan/capture/motor/motor.hpp>
#include <turnscan/core/angles.hpp>

#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace turnscan::cli {

namespace {

struct TurnOptions {
  double angle_rad = 2.0 * std::numbers::pi;
  double speed_rad_s = 0.34906585;
  std::optional<double> seconds;
};

OptionTable describe(TurnOptions& o) {
  OptionTable table;
  table
      .number("angle", o.angle_rad, Quantity::kAngle, {-628.3, 628.3},
              "rotate: by how much; counter-clockwise seen from above is positive")
      .number("speed", o.speed_rad_s, Quantity::kAngularSpeed, {-100.0, 100.0},
              "rotate, speed: how fast; with speed the sign gives the direction")
      .number("seconds", o.seconds, Quantity::kNone, {0.0, 1e6},
              "speed: for how long; default: until Ctrl-C");
  return table;
}

class TurntableCommand : public Command {
 public:
  void declare(CommandLine& line) override {
    line.positional("ACTION", action_,
                    "rotate: turn by an angle; speed: turn continuously; stop; status: report what "
                    "the table does");
    line.required_option("--port", "PORT", port_,
                         "Serial port, e.g. /dev/ttyUSB0, or tcp:HOST:PORT");
    line.allow_config();
    line.group("turn", "Turning", describe(turn_));
    line.group("motor", "Motor", describe(motor_));
    line.common({"port", "angle", "speed", "seconds", "motor-protocol", "motor-baud", "motor-units",
                 "motor-max-speed", "motor-reversed"});
  }

  FileRoles files() const override { return {}; }

  Result<> run(Session& session) override {
    if (action_ != "rotate" && action_ != "speed" && action_ != "stop" && action_ != "status")
      return fail(ErrorCode::kInvalidOption,
                  "ACTION {}: there is no such action; use rotate, speed, stop or status", action_);
    session.context().begin_phase("connect", 0);
    TURNSCAN_ASSIGN(Motor motor, Motor::open(port_, motor_, session.context()));
    if (action_ == "rotate") TURNSCAN_TRY(rotate(motor, session));
    if (action_ == "speed") TURNSCAN_TRY(spin(motor, session));
    if (action_ == "stop") TURNSCAN_TRY(motor.stop());
    TURNSCAN_ASSIGN(const MotorStatus status, motor.status());
    session.print("{}: {}, {} at {:.2f} deg\n", port_, motor.board(), name_of(status.state),
                  status.angle_rad * kDegreesPerRadian);
    return {};
  }

 private:
  Result<> rotate(Motor& motor, Session& session) const {
    session.context().begin_phase("rotate", 0);
    return motor.rotate(turn_.angle_rad, std::abs(turn_.speed_rad_s), session.context());
  }

  Result<> spin(Motor& motor, Session& session) const {
    session.context().begin_phase("turn", 0);
    TURNSCAN_TRY(motor.spin(turn_.speed_rad_s));
    const auto begin = std::chrono::steady_clock::now();
    while (!session.context().cancelled()) {
      TURNSCAN_TRY(motor.watch());
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      const std::chrono::duration<double> since = std::chrono::steady_clock::now() - begin;
      if (turn_.seconds && since.count() >= *turn_.seconds) break;
    }
    TURNSCAN_TRY(motor.stop());
    // Without a duration, Ctrl-C is the intended way to end it.
    return turn_.seconds ? session.context().check() : Result<>();
  }

  std::string action_, port_;
  TurnOptions turn_;
  MotorOptions motor_;
};

}  // namespace

std::unique_ptr<Command> make_turntable_command() { return std::make_unique<TurntableCommand>(); }

}  // namespace turnscan::cli
