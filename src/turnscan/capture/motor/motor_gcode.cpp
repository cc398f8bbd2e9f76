// Boards that understand G-code, in one of the dialects of gcode_dialect.hpp: lines, each answered
// by "ok" or a refusal, which queue motion.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <turnscan/capture/motor/gcode_dialect.hpp>
#include <turnscan/capture/motor/motor_board.hpp>
#include <turnscan/core/stopwatch.hpp>

namespace turnscan::motor {

namespace {

/// A spin is sent in pieces of this duration; the board joins them.
constexpr double kPiece_s = 0.5;
constexpr auto kStopPoll = std::chrono::milliseconds(30);
/// Waited after a first move that may have ended before the board was asked.
constexpr auto kUnseenMotion = std::chrono::milliseconds(500);
constexpr double kQuiet_s = 0.05;  ///< a board may repeat its first line within this time

/// Maximum number of times that a command is repeated because the board asks for it.
constexpr int kRepeats = 3;
/// Marlin says every 2 s that it is busy (DEFAULT_KEEPALIVE_INTERVAL).
constexpr double kBusy_s = 2.5;

class GcodeBoard : public MotorBoard {
 public:
  GcodeBoard(SerialPort& port, const MotorOptions& options, const GcodeDialect& dialect,
             std::string banner)
      : port_(port),
        dialect_(dialect),
        timeout_s_(options.timeout_s),
        boot_s_(options.boot_s),
        units_per_deg_(options.units_per_turn / 360.0),
        name_(std::move(banner)) {}

  const std::string& name() const override { return name_; }

  /// Setup after a start or a reset.
  Result<> prepare() {
    if (dialect_.numbered) {
      number_ = -1;
      // Ends what another protocol's bytes began, and waits until the board has answered that.
      TURNSCAN_TRY(port_.write("\n"));
      TURNSCAN_TRY(settle());
      // A board that just greeted may still be starting.
      TURNSCAN_TRY(command("M110 N0", std::max(timeout_s_, boot_s_)));
    } else {
      TURNSCAN_ASSIGN(const GcodeStatus now, query());
      if (now.state.starts_with("Alarm")) TURNSCAN_TRY(command(dialect_.unlock, timeout_s_));
    }
    for (const std::string_view line : dialect_.setup) TURNSCAN_TRY(command(line, timeout_s_));
    if (!dialect_.no_limits.empty()) {
      const auto done = command(dialect_.no_limits, timeout_s_);
      if (!done && !refused_) return done;
    }
    if (dialect_.numbered && !(steps_per_unit_ > 0.0))
      return fail(ErrorCode::kUnsupported,
                  "the board does not report its steps per unit (M92), by which it counts: {} 2.0 "
                  "or newer is needed",
                  dialect_.name);
    return {};
  }

  Result<> reset() {
    resetting_ = true;
    const auto done = [&]() -> Result<> {
      TURNSCAN_TRY(port_.write(dialect_.reset));
      const auto begin = Clock::now();
      for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
        TURNSCAN_ASSIGN(const auto line, port_.read_line(timeout_s_ - seconds_since(begin)));
        if (!line) return no_answer("reset");
        if (greeted_by(*line)) {
          name_ = *line;
          return take_second_banner();
        }
      }
      return without_end("reset");
    }();
    resetting_ = false;
    return done;
  }

  Result<> take_second_banner() {
    TURNSCAN_ASSIGN(const auto line, port_.read_line(kQuiet_s));
    if (line) strange_ = *line;
    return {};
  }

  Result<> spin(double deg_per_s) override {
    TURNSCAN_ASSIGN(const BoardStatus now, status());
    spin_deg_s_ = deg_per_s;
    sent_deg_ = now.angle_deg;
    return keep_spinning(now.angle_deg);
  }

  /// Refills the board's queue of pieces.
  Result<> keep_spinning(double angle_deg) override {
    const double piece = spin_deg_s_ * kPiece_s;
    while (std::abs(sent_deg_ - angle_deg) < std::abs(spin_deg_s_) * kSpinAhead_s) {
      TURNSCAN_TRY(move(piece, std::abs(spin_deg_s_)));
      sent_deg_ += piece;
    }
    return {};
  }

  Result<> move(double deg, double deg_per_s) override {
    const auto begin = Clock::now();
    TURNSCAN_TRY(command(
        fmt::format("G1X{:.4f}F{:.3f}", deg * units_per_deg_, deg_per_s * units_per_deg_ * 60.0),
        timeout_s_));
    return see_motion(begin, std::abs(deg) / deg_per_s);
  }

  /// A hold decelerates without losing steps; the reset then discards the rest of the motion.
  Result<> stop() override {
    TURNSCAN_TRY(hold());
    last_x_.reset();
    const auto begin = Clock::now();
    for (;;) {
      TURNSCAN_ASSIGN(const GcodeStatus now, query());
      if (now.state == "Idle" || now.state == "Hold:0" || now.state.starts_with("Alarm")) break;
      // 0.9 only reports "Hold": the table stands still if the position no longer changes.
      if (now.state == "Hold" && last_x_ == now.x) break;
      last_x_ = now.x;
      if (seconds_since(begin) > kStopTimeout_s)
        return fail(ErrorCode::kIo, "the table does not stop: the board says '{}'",
                    shown(now.state));
      std::this_thread::sleep_for(kStopPoll);
    }
    if (dialect_.reset.empty()) return {};
    TURNSCAN_TRY(reset());
    return prepare();
  }

  Result<BoardStatus> status() override {
    TURNSCAN_ASSIGN(const GcodeStatus now, query());
    BoardStatus out;
    TURNSCAN_ASSIGN(out.angle_deg, checked_angle(now.x / units_per_deg_));
    if (now.state == "Run" || now.state == "Jog" || now.state == "Home") {
      out.state = MotorState::kTurning;
    } else if (now.state != "Idle" && now.state != "Check") {
      out.state = MotorState::kHalted;
    }
    return out;
  }

  Result<> halt() override {
    Result<> done;
    for (int i = 0; i < kHaltTries; ++i) {
      done = halted();
      if (done) return done;
    }
    return done;
  }

 private:
  Result<> hold() {
    if (!dialect_.numbered) return port_.write(dialect_.hold);
    // Begins with a line end, so that half a command does not swallow it.
    TURNSCAN_TRY(port_.write(fmt::format("\n{}", dialect_.hold)));
    return settle(timeout_s_);
  }

  /// Reads until the board is quiet: what it answers to lines without a number cannot be told
  /// apart. ok_s: time in which an "ok" must come, which else would answer the next command.
  Result<> settle(double ok_s = 0.0) {
    const auto begin = Clock::now();
    bool ok = false;
    for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
      const double wait_s = ok ? kQuiet_s : std::max(kQuiet_s, ok_s - seconds_since(begin));
      TURNSCAN_ASSIGN(const auto line, port_.read_line(wait_s));
      if (!line) return {};
      ok |= line->starts_with("ok");
      TURNSCAN_TRY(take_unasked(*line));
      strange_ = *line;
    }
    return without_end("nothing");
  }

  /// A board that cannot say where it is while it turns seems to stand, and must not be believed
  /// that it has arrived. begin: when it was told to turn.
  Result<> see_motion(Clock::time_point begin, double duration_s) {
    if (dialect_.query_end.empty() || motion_seen_) return {};
    TURNSCAN_TRY(query());
    if (motion_seen_) return {};
    if (seconds_since(begin) < duration_s)
      return fail(ErrorCode::kUnsupported,
                  "the board does not report where the table is while it turns: {} 2.0.6 or newer "
                  "is needed, built with M114_REALTIME",
                  dialect_.name);
    std::this_thread::sleep_for(kUnseenMotion);
    return {};
  }

  Result<> halted() {
    TURNSCAN_TRY(hold());
    if (!dialect_.reset.empty()) return reset();
    // Without a reset the count of steps shows that the table stands.
    resetting_ = true;  // a board that restarted stands still, too
    const auto done = [&]() -> Result<> {
      TURNSCAN_TRY(prepare());
      TURNSCAN_ASSIGN(const GcodeStatus now, query());
      if (now.state == "Idle") return {};
      return fail(ErrorCode::kIo, "the table does not stop: it says that it stands at {:.2f}",
                  now.x);
    }();
    resetting_ = false;
    return done;
  }

  tl::unexpected<Error> no_answer(std::string_view request) const {
    std::string why = "nothing came";
    if (!strange_.empty()) why = fmt::format("it sent '{}' instead", shown(strange_));
    if (strange_.empty() && !port_.half_line().empty())
      why = fmt::format("only half a line came: '{}'", shown(port_.half_line()));
    return fail(ErrorCode::kDeviceLost, "the table did not answer '{}' within {:.1f} s ({})",
                request, timeout_s_, why);
  }
  tl::unexpected<Error> without_end(std::string_view request) const {
    return fail(ErrorCode::kIo, "the table sends without end instead of answering '{}': '{}'",
                request, shown(strange_));
  }

  /// Handles messages that may arrive at any time. Fails for those after which the table's state is
  /// no longer valid.
  Result<> take_unasked(const std::string& line) {
    if (line.starts_with(dialect_.alarm))
      return fail(ErrorCode::kIo, "the table reports '{}'", shown(line));
    if (greeted_by(line) && !resetting_)
      return fail(ErrorCode::kIo, "the table's board restarted by itself; check its power supply");
    if (const auto steps = steps_in(line)) steps_per_unit_ = *steps;
    return {};
  }

  /// Reads what arrived since the last answer: nothing, or unsolicited messages.
  Result<> drain() {
    for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
      TURNSCAN_ASSIGN(const auto line, port_.read_line(0.0));
      if (!line) return {};
      TURNSCAN_TRY(take_unasked(*line));
      strange_ = *line;
    }
    return without_end("nothing");
  }

  /// The command as it is sent, without its line end.
  std::string framed(std::string_view text) {
    if (!dialect_.numbered) return std::string(text);
    const std::string line = fmt::format("N{} {}", ++number_, text);
    unsigned sum = 0;
    for (const char c : line) sum ^= static_cast<unsigned char>(c);
    return fmt::format("{}*{}", line, sum);
  }

  Result<> command(std::string_view text, double timeout_s) {
    TURNSCAN_TRY(drain());
    const std::string sent = framed(text);
    TURNSCAN_TRY(port_.write(sent + "\n"));
    strange_.clear();
    status_.reset();
    refused_ = false;
    std::string refusal;
    int repeats = 0;
    bool again = false;
    const auto begin = Clock::now();
    double until_s = timeout_s;
    for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
      TURNSCAN_ASSIGN(const auto line, port_.read_line(until_s - seconds_since(begin)));
      if (!line) return no_answer(text);
      if (*line == "ok" || (dialect_.numbered && line->starts_with("ok "))) {
        if (!again) return refusal.empty() ? Result<>() : refused(text, refusal);
        if (++repeats > kRepeats)
          return fail(ErrorCode::kIo, "the table asks for '{}' again and again; check its cable",
                      text);
        again = false;
        refusal.clear();
        TURNSCAN_TRY(port_.write(sent + "\n"));
        continue;
      }
      TURNSCAN_TRY(take_unasked(*line));
      if (dialect_.numbered && (line->starts_with("Resend:") || line->starts_with("rs "))) {
        again = true;
      } else if (dialect_.numbered && line->find("busy:") != std::string::npos) {
        const double longer_s = seconds_since(begin) + std::max(kBusy_s, timeout_s);
        until_s = std::max(until_s, std::min(longer_s, kStopTimeout_s));
      } else if (refuses(*line)) {
        refusal = *line;
        // Only numbered lines have an end behind their refusal.
        if (!dialect_.numbered) return refused(text, refusal);
      } else if (auto status = dialect_.status_in(*line, steps_per_unit_)) {
        status_ = std::move(status);
      } else if (!line->starts_with('[')) {
        strange_ = *line == sent ? "what it was told (an echo)" : *line;
      }
    }
    return without_end(text);
  }

  Result<> refused(std::string_view text, std::string_view refusal) {
    refused_ = true;
    return fail(ErrorCode::kIo, "the table refused '{}': {}", text, shown(refusal));
  }

  bool refuses(std::string_view line) const {
    return std::any_of(dialect_.refusals.begin(), dialect_.refusals.end(),
                       [&](std::string_view word) { return line.starts_with(word); });
  }

  Result<GcodeStatus> asked(std::string_view question) {
    TURNSCAN_TRY(command(question, timeout_s_));
    if (!status_) return no_answer(question);
    return *status_;
  }

  Result<GcodeStatus> query() {
    if (dialect_.numbered) {
      TURNSCAN_ASSIGN(GcodeStatus now, asked(dialect_.query));
      TURNSCAN_ASSIGN(const GcodeStatus end, asked(dialect_.query_end));
      if (std::abs(end.x - now.x) * steps_per_unit_ > 1.5) {  // steps
        now.state = "Run";
        motion_seen_ = true;
      }
      return now;
    }
    TURNSCAN_TRY(drain());
    TURNSCAN_TRY(port_.write(dialect_.query));
    strange_.clear();
    const auto begin = Clock::now();
    for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
      TURNSCAN_ASSIGN(const auto line, port_.read_line(timeout_s_ - seconds_since(begin)));
      if (!line) return no_answer(dialect_.query);
      if (const auto status = dialect_.status_in(*line, 0.0)) return *status;
      TURNSCAN_TRY(take_unasked(*line));
      strange_ = *line;
    }
    return without_end(dialect_.query);
  }

  SerialPort& port_;
  const GcodeDialect& dialect_;
  double timeout_s_, boot_s_;
  double units_per_deg_;
  double steps_per_unit_ = 0.0;
  int number_ = -1;                    ///< of the last line that was sent
  std::optional<GcodeStatus> status_;  ///< in the lines before the last "ok"
  std::string name_;
  std::string strange_;  ///< the last line received instead of an answer
  bool resetting_ = false;
  bool refused_ = false;      ///< the last command, by the board
  bool motion_seen_ = false;  ///< the board has said that the table was on its way
  double spin_deg_s_ = 0.0;
  double sent_deg_ = 0.0;  ///< end position of the pieces sent so far
  std::optional<double> last_x_;
};

}  // namespace

Result<std::unique_ptr<MotorBoard>> open_gcode_board(SerialPort& port, const MotorOptions& options,
                                                     const GcodeDialect& dialect,
                                                     std::string banner) {
  const bool reset = banner.empty() && !dialect.reset.empty();
  if (banner.empty()) banner = dialect.name;
  auto board = std::make_unique<GcodeBoard>(port, options, dialect, std::move(banner));
  if (reset) TURNSCAN_TRY(board->reset());
  TURNSCAN_TRY(board->prepare());
  return std::unique_ptr<MotorBoard>(std::move(board));
}

}  // namespace turnscan::motor
