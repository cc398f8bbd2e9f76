// Boards that understand GRBL: lines of G-code, each answered by "ok" or "error:N", and single
// bytes that take effect at once ('?' status, '!' hold, 0x18 reset). Source: the interface
// description of Grbl 1.1 (doc/markdown/interface.md and commands.md in its repository); 0.9 and
// the boards derived from it differ only in the status line.

#include <chrono>
#include <cmath>
#include <thread>
#include <turnscan/capture/motor/motor_board.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::motor {

namespace {

/// A spin is sent in pieces of this duration; the board joins them.
constexpr double kPiece_s = 0.5;
constexpr auto kStopPoll = std::chrono::milliseconds(30);
constexpr double kBannerTwice_s = 0.05;  ///< a board may repeat its first line

struct GrblStatus {
  std::string state;
  double x = 0.0;
};

/// "<Idle|MPos:1.000,0.000,0.000|FS:0,0>" or "<Idle,MPos:1.000,0.000,0.000,WPos:...>"
std::optional<GrblStatus> parse_status(std::string_view line) {
  if (line.size() < 3 || line.front() != '<' || line.back() != '>') return std::nullopt;
  line = line.substr(1, line.size() - 2);
  GrblStatus out;
  out.state = std::string(line.substr(0, line.find_first_of("|,")));
  auto at = line.find("MPos:");
  if (at == std::string_view::npos) at = line.find("WPos:");
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = line.substr(at + 5);
  const auto x = parse_number(rest.substr(0, rest.find_first_of(",|>")));
  if (!x) return std::nullopt;
  out.x = *x;
  return out;
}

class GrblBoard : public MotorBoard {
 public:
  GrblBoard(SerialPort& port, const MotorOptions& options, std::string banner)
      : port_(port),
        timeout_s_(options.timeout_s),
        units_per_deg_(options.units_per_turn / 360.0),
        name_(std::move(banner)) {}

  const std::string& name() const override { return name_; }

  /// Setup after a reset: unlocks, and selects relative distances.
  Result<> prepare() {
    TURNSCAN_ASSIGN(const GrblStatus now, query());
    if (now.state.starts_with("Alarm")) TURNSCAN_TRY(command("$X"));
    TURNSCAN_TRY(command("G21"));
    return command("G91");
  }

  Result<> reset() {
    resetting_ = true;
    const auto done = [&]() -> Result<> {
      TURNSCAN_TRY(port_.write("\x18"));
      const auto begin = Clock::now();
      for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
        TURNSCAN_ASSIGN(const auto line, port_.read_line(timeout_s_ - seconds_since(begin)));
        if (!line) return no_answer("reset");
        if (is_grbl_banner(*line)) {
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
    TURNSCAN_ASSIGN(const auto line, port_.read_line(kBannerTwice_s));
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
    return command(
        fmt::format("G1X{:.4f}F{:.3f}", deg * units_per_deg_, deg_per_s * units_per_deg_ * 60.0));
  }

  /// A hold decelerates without losing steps; the reset then discards the rest of the motion.
  Result<> stop() override {
    TURNSCAN_TRY(port_.write("!"));
    last_x_.reset();
    const auto begin = Clock::now();
    for (;;) {
      TURNSCAN_ASSIGN(const GrblStatus now, query());
      if (now.state == "Idle" || now.state == "Hold:0" || now.state.starts_with("Alarm")) break;
      // 0.9 only reports "Hold": the table stands still if the position no longer changes.
      if (now.state == "Hold" && last_x_ == now.x) break;
      last_x_ = now.x;
      if (seconds_since(begin) > kStopTimeout_s)
        return fail(ErrorCode::kIo, "the table does not stop: the board says '{}'",
                    shown(now.state));
      std::this_thread::sleep_for(kStopPoll);
    }
    TURNSCAN_TRY(reset());
    return prepare();
  }

  Result<BoardStatus> status() override {
    TURNSCAN_ASSIGN(const GrblStatus now, query());
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
      TURNSCAN_TRY(port_.write("!"));
      done = reset();
      if (done) return done;
    }
    return done;
  }

 private:
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
    if (line.starts_with("ALARM"))
      return fail(ErrorCode::kIo, "the table reports '{}'", shown(line));
    if (is_grbl_banner(line) && !resetting_)
      return fail(ErrorCode::kIo, "the table's board restarted by itself; check its power supply");
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

  Result<> command(const std::string& text) {
    TURNSCAN_TRY(drain());
    TURNSCAN_TRY(port_.write(text + "\n"));
    strange_.clear();
    const auto begin = Clock::now();
    for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
      TURNSCAN_ASSIGN(const auto line, port_.read_line(timeout_s_ - seconds_since(begin)));
      if (!line) return no_answer(text);
      if (*line == "ok") return {};
      if (line->starts_with("error"))
        return fail(ErrorCode::kIo, "the table refused '{}': {}", text, shown(*line));
      TURNSCAN_TRY(take_unasked(*line));
      if (!line->starts_with('[') && !line->starts_with('<'))
        strange_ = *line == text ? "what it was told (an echo)" : *line;
    }
    return without_end(text);
  }

  Result<GrblStatus> query() {
    TURNSCAN_TRY(drain());
    TURNSCAN_TRY(port_.write("?"));
    strange_.clear();
    const auto begin = Clock::now();
    for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
      TURNSCAN_ASSIGN(const auto line, port_.read_line(timeout_s_ - seconds_since(begin)));
      if (!line) return no_answer("?");
      if (const auto status = parse_status(*line)) return *status;
      TURNSCAN_TRY(take_unasked(*line));
      strange_ = *line;
    }
    return without_end("?");
  }

  SerialPort& port_;
  double timeout_s_;
  double units_per_deg_;
  std::string name_;
  std::string strange_;  ///< the last line received instead of an answer
  bool resetting_ = false;
  double spin_deg_s_ = 0.0;
  double sent_deg_ = 0.0;  ///< end position of the pieces sent so far
  std::optional<double> last_x_;
};

}  // namespace

bool is_grbl_banner(std::string_view line) {
  return (line.starts_with("Grbl ") || line.starts_with("GrblHAL ") ||
          line.starts_with("Horus ")) &&
         line.find("for help]") != std::string_view::npos;
}

Result<std::unique_ptr<MotorBoard>> open_grbl_board(SerialPort& port, const MotorOptions& options,
                                                    std::string banner) {
  const bool reset = banner.empty();
  auto board = std::make_unique<GrblBoard>(port, options, std::move(banner));
  if (reset) TURNSCAN_TRY(board->reset());
  TURNSCAN_TRY(board->prepare());
  return std::unique_ptr<MotorBoard>(std::move(board));
}

}  // namespace turnscan::motor
