#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <thread>
#include <turnscan/capture/motor/motor.hpp>
#include <turnscan/capture/motor/motor_board.hpp>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/stopwatch.hpp>

namespace turnscan::motor {

namespace {

constexpr auto kArrivalPoll = std::chrono::milliseconds(50);
constexpr double kWatchEvery_s = 0.3;
constexpr double kStall_s = 1.5;      ///< interval over which progress is judged
constexpr double kStallShare = 0.25;  ///< of the expected angle
/// Maximum ratio of a move's duration to that expected from its speed.
constexpr double kRampShare = 3.0;

/// Checks whether the angle grows at the expected speed. Considers the last seconds, so that a ramp
/// is not mistaken for a stall.
class Advance {
 public:
  void begin(double speed_deg_s) {
    speed_ = std::abs(speed_deg_s);
    samples_.clear();
  }
  bool stalled(double angle_deg) {
    const auto now = Clock::now();
    samples_.push_back({now, angle_deg});
    while (samples_.size() > 2 && seconds_since(samples_[1].first) > kStall_s) samples_.pop_front();
    const double time = std::chrono::duration<double>(now - samples_.front().first).count();
    if (time < kStall_s) return false;
    return std::abs(angle_deg - samples_.front().second) < kStallShare * speed_ * time;
  }

 private:
  double speed_ = 0.0;
  std::deque<std::pair<Clock::time_point, double>> samples_;
};

struct Greeting {
  const GcodeDialect* dialect = nullptr;
  std::string line;
};

/// Reads the lines sent while the board starts; returns the first greeting of a board with G-code.
Result<Greeting> wait_for_greeting(SerialPort& port, double boot_s, const RunContext& context) {
  const auto begin = Clock::now();
  while (seconds_since(begin) < boot_s) {
    TURNSCAN_TRY(context.check());
    TURNSCAN_ASSIGN(const auto line, port.read_line(std::min(0.1, boot_s)));
    if (!line) continue;
    if (const GcodeDialect* dialect = greeted_by(*line))
      return Greeting{dialect, dialect->numbered ? std::string() : *line};
    if (line->find("0 ready") == 0) break;
  }
  return Greeting();
}

/// Tries the protocols one by one: first the one that does no harm to the others.
Result<std::unique_ptr<MotorBoard>> open_board(SerialPort& port, const MotorOptions& options,
                                               const RunContext& context) {
  TURNSCAN_ASSIGN(Greeting greeting, wait_for_greeting(port, options.boot_s, context));
  if (const GcodeDialect* stated = dialect_of(options.protocol); stated && !greeting.dialect)
    greeting.dialect = stated;
  if (greeting.dialect) return open_gcode_board(port, options, *greeting.dialect, greeting.line);
  auto text = open_text_board(port, options);
  if (text || options.protocol == MotorProtocol::kTurnscan) return text;
  std::string others;
  for (const MotorProtocol protocol : {MotorProtocol::kGrbl, MotorProtocol::kMarlin}) {
    const GcodeDialect& dialect = *dialect_of(protocol);
    auto board = open_gcode_board(port, options, dialect, "");
    if (board) return board;
    others += fmt::format("; as {}: {}", dialect.name, board.error().message);
  }
  return fail(ErrorCode::kDeviceLost,
              "no turntable answers: {}{}; check --motor-baud and the board's power",
              text.error().message, others);
}

Error at_port(Error error, const std::string& port) {
  if (error.path.empty()) error.path = port;
  return error;
}

}  // namespace

Result<double> checked_angle(double deg) {
  constexpr double kMax_deg = 3.6e8;
  if (std::abs(deg) <= kMax_deg) return deg;
  return fail(ErrorCode::kIo, "the table says that it stands at {:.1f} deg; check --motor-units",
              deg);
}

std::string shown(std::string_view line) {
  constexpr std::size_t kMax = 60;
  std::string out;
  for (const char c : line.substr(0, kMax)) out += c >= 0x20 && c < 0x7f ? c : '?';
  return line.size() > kMax ? out + "..." : out;
}

}  // namespace turnscan::motor

namespace turnscan {

using namespace motor;

std::string_view name_of(MotorState state) {
  if (state == MotorState::kIdle) return "idle";
  return state == MotorState::kTurning ? "turning" : "halted";
}

OptionTable describe(MotorOptions& o) {
  OptionTable table;
  table
      .choice("motor-protocol", o.protocol,
              {"auto", "turnscan", "grbl", "grblhal", "fluidnc", "marlin"},
              "Protocol of the turntable's board: the text protocol of docs/reference/motor.md, or "
              "a dialect of G-code; auto: recognised from its greeting")
      .number("motor-baud", o.baud, {300, 4000000}, "Baud rate of the serial port")
      .number("motor-timeout", o.timeout_s, Quantity::kTime, {0.02, 60.0},
              "Time in which the board must answer")
      .number("motor-boot", o.boot_s, Quantity::kTime, {0.0, 60.0},
              "Time that the board may take to start after its port was opened")
      .number("motor-units", o.units_per_turn, Quantity::kNone, {1e-3, 1e6},
              "Boards with G-code: travel of axis X in one turn of the platter")
      .number("motor-max-speed", o.max_speed_rad_s, Quantity::kAngularSpeed, {1e-3, 100.0},
              "Greatest speed at which the table is told to turn")
      .flag("motor-reversed", o.reversed,
            "The board's positive direction is clockwise, seen from above");
  return table;
}

struct Motor::State {
  State(SerialPort p, const MotorOptions& o) : port(std::move(p)), options(o) {}

  SerialPort port;
  MotorOptions options;
  std::unique_ptr<MotorBoard> board;
  double start_deg = 0.0;
  bool spinning = false;
  bool may_turn = false;  ///< commanded to turn, and not yet seen standing still
  Advance progress;
  Clock::time_point watched;

  double sign() const { return options.reversed ? -1.0 : 1.0; }

  /// Passes results through; after a failure the table is stopped, and the error says so.
  template <class T>
  Result<T> guard(Result<T> result) {
    if (result) return result;
    const bool moved = may_turn;
    const bool stopped = board->halt().has_value();
    spinning = may_turn = false;
    Error error = at_port(std::move(result).error(), port.name());
    if (error.code == ErrorCode::kCancelled && stopped) return tl::unexpected<Error>(error);
    if (!stopped) {
      error.code = ErrorCode::kDeviceLost;
      error.message += moved ? "; whether the table stopped is not known: switch its power off"
                             : "; the table did not turn";
    } else if (error.message.find("; ") == std::string::npos) {
      error.message += "; the table was stopped";
    } else {
      error.message += " (the table was stopped)";
    }
    return tl::unexpected<Error>(std::move(error));
  }

  Result<double> speed_of(double speed_rad_s) const {
    if (std::isfinite(speed_rad_s) && std::abs(speed_rad_s) > 1e-9 &&
        std::abs(speed_rad_s) <= options.max_speed_rad_s)
      return speed_rad_s / kRadiansPerDegree * sign();
    return fail(ErrorCode::kInvalidOption,
                "motor: the speed {:.3f} deg/s is not within {:.3f} deg/s (motor-max-speed), or 0",
                speed_rad_s / kRadiansPerDegree, options.max_speed_rad_s / kRadiansPerDegree);
  }

  Result<> wait_until_there(double target_deg, double speed_deg_s, double most_s,
                            const RunContext& context);
  Result<> look();
};

/// Waits until the table stands still at the target.
Result<> Motor::State::wait_until_there(double target_deg, double speed_deg_s, double most_s,
                                        const RunContext& context) {
  progress.begin(speed_deg_s);
  const auto begin = Clock::now();
  for (;;) {
    TURNSCAN_TRY(context.check());
    TURNSCAN_ASSIGN(const BoardStatus now, board->status());
    const double off = std::abs(now.angle_deg - target_deg);
    if (now.state == MotorState::kHalted)
      return fail(ErrorCode::kIo, "the table halted by itself, {:.2f} deg before its target", off);
    if (now.state == MotorState::kIdle) {
      if (off < 0.5) return {};
      return fail(ErrorCode::kIo, "the table stands {:.2f} deg from where it was told to go", off);
    }
    if (progress.stalled(now.angle_deg))
      return fail(ErrorCode::kIo, "the table does not turn although it was told to (stalled)");
    if (seconds_since(begin) > most_s)
      return fail(ErrorCode::kIo, "the table has not arrived after {:.1f} s", most_s);
    std::this_thread::sleep_for(kArrivalPoll);
  }
}

Result<> Motor::State::look() {
  TURNSCAN_ASSIGN(const BoardStatus now, board->status());
  if (now.state != MotorState::kTurning)
    return fail(ErrorCode::kIo, "the table stopped by itself (it says it is {})",
                name_of(now.state));
  if (progress.stalled(now.angle_deg))
    return fail(ErrorCode::kIo, "the table does not turn although it was told to (stalled)");
  return board->keep_spinning(now.angle_deg);
}

Motor::Motor(std::unique_ptr<State> state) : state_(std::move(state)) {}
Motor::Motor(Motor&&) noexcept = default;
Motor& Motor::operator=(Motor&&) noexcept = default;

Motor::~Motor() {
  if (state_ && state_->may_turn) (void)state_->board->halt();
}

Result<Motor> Motor::open(const std::string& port, const MotorOptions& options,
                          const RunContext& context) {
  MotorOptions checked = options;
  TURNSCAN_TRY(describe(checked).check());
  TURNSCAN_ASSIGN(SerialPort opened, SerialPort::open(port, options.baud));
  auto state = std::make_unique<State>(std::move(opened), options);
  auto board = open_board(state->port, options, context);
  if (!board) return tl::unexpected<Error>(at_port(std::move(board).error(), port));
  state->board = std::move(*board);
  auto status = state->board->status();
  if (!status) return tl::unexpected<Error>(at_port(std::move(status).error(), port));
  state->start_deg = status->angle_deg;
  state->may_turn = status->state == MotorState::kTurning;
  return Motor(std::move(state));
}

const std::string& Motor::board() const { return state_->board->name(); }

Result<> Motor::spin(double speed_rad_s) {
  TURNSCAN_ASSIGN(const double speed, state_->speed_of(speed_rad_s));
  state_->may_turn = state_->spinning = true;
  state_->progress.begin(speed);
  state_->watched = Clock::now();
  return state_->guard(state_->board->spin(speed));
}

Result<> Motor::rotate(double angle_rad, double speed_rad_s, const RunContext& context) {
  TURNSCAN_ASSIGN(const double signed_speed, state_->speed_of(speed_rad_s));
  const double angle = angle_rad / kRadiansPerDegree * state_->sign(),
               speed = std::abs(signed_speed);
  if (!(std::abs(angle) <= 36000.0))
    return fail(ErrorCode::kInvalidOption, "motor: the angle is not within 100 turns");
  const double most_s = kRampShare * std::abs(angle) / speed + 5.0;
  state_->may_turn = true;
  const auto done = state_->guard([&]() -> Result<> {
    TURNSCAN_ASSIGN(const BoardStatus before, state_->board->status());
    TURNSCAN_TRY(state_->board->move(angle, speed));
    return state_->wait_until_there(before.angle_deg + angle, speed, most_s, context);
  }());
  state_->may_turn = false;
  return done;
}

Result<> Motor::stop() {
  const auto done = state_->guard(state_->board->stop());
  state_->spinning = state_->may_turn = false;
  return done;
}

Result<MotorStatus> Motor::status() {
  TURNSCAN_ASSIGN(const BoardStatus now, state_->guard(state_->board->status()));
  MotorStatus out;
  out.state = now.state;
  out.board_rad = now.angle_deg * kRadiansPerDegree * state_->sign();
  out.angle_rad = (now.angle_deg - state_->start_deg) * kRadiansPerDegree * state_->sign();
  return out;
}

Result<> Motor::watch() {
  if (!state_->spinning || seconds_since(state_->watched) < kWatchEvery_s) return {};
  state_->watched = Clock::now();
  return state_->guard(state_->look());
}

}  // namespace turnscan
