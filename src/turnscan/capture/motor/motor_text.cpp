// The text protocol of docs/reference/motor.md: numbered lines with a checksum.

#include <algorithm>
#include <charconv>
#include <turnscan/capture/motor/motor_board.hpp>
#include <turnscan/core/stopwatch.hpp>
#include <turnscan/core/units.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::motor {

namespace {

unsigned checksum(std::string_view text) {
  unsigned sum = 0;
  for (const char c : text) sum ^= static_cast<unsigned char>(c);
  return sum;
}

/// "12 ok *5a" -> "12 ok"; nullopt: damaged.
std::optional<std::string_view> unsealed(std::string_view line) {
  const auto star = line.rfind(" *");
  if (star == std::string_view::npos || line.size() != star + 4) return std::nullopt;
  unsigned given = 0;
  const char* first = line.data() + star + 2;
  const auto parsed = std::from_chars(first, first + 2, given, 16);
  if (parsed.ec != std::errc() || parsed.ptr != first + 2) return std::nullopt;
  if (given != checksum(line.substr(0, star))) return std::nullopt;
  return line.substr(0, star);
}

class TextBoard : public MotorBoard {
 public:
  TextBoard(SerialPort& port, const MotorOptions& options)
      : port_(port), timeout_s_(options.timeout_s) {}

  const std::string& name() const override { return name_; }

  Result<> hello() {
    TURNSCAN_ASSIGN(const std::string answer, ask("hello", timeout_s_));
    const auto words = text::words_of(answer);
    if (words.size() < 2 || words[0] != "turnscan-table")
      return fail(ErrorCode::kIo, "the board calls itself '{}', which is no turntable",
                  shown(answer));
    if (words[1] != "1")
      return fail(ErrorCode::kIo, "the table speaks version {} of the protocol, not version 1",
                  shown(words[1]));
    name_ = answer;
    greeted_ = true;
    return {};
  }

  Result<> spin(double deg_per_s) override {
    return ask_for_nothing(fmt::format("spin {:.4f}", deg_per_s), timeout_s_);
  }
  Result<> move(double deg, double deg_per_s) override {
    return ask_for_nothing(fmt::format("move {:.4f} {:.4f}", deg, deg_per_s), timeout_s_);
  }
  Result<> stop() override { return ask_for_nothing("stop", std::max(timeout_s_, kStopTimeout_s)); }

  Result<BoardStatus> status() override {
    TURNSCAN_ASSIGN(const std::string answer, ask("status", timeout_s_));
    const auto words = text::words_of(answer);
    BoardStatus out;
    if (words.size() < 2) return not_understood(answer);
    if (words[0] == "turning") {
      out.state = MotorState::kTurning;
    } else if (words[0] == "halted") {
      out.state = MotorState::kHalted;
    } else if (words[0] != "idle") {
      return not_understood(answer);
    }
    const auto angle = parse_number(words[1]);
    if (!angle) return not_understood(answer);
    TURNSCAN_ASSIGN(out.angle_deg, checked_angle(*angle));
    return out;
  }

  Result<> halt() override {
    Result<> done;
    for (int i = 0; i < kHaltTries; ++i) {
      // Begins with a line end, so that a partial command does not swallow it.
      TURNSCAN_TRY(port_.write("!\n!"));
      greeted_ = false;  // a board that restarted stands still, too
      done = ask_for_nothing("stop", timeout_s_);
      if (done) return done;
    }
    return done;
  }

 private:
  static tl::unexpected<Error> not_understood(std::string_view answer) {
    return fail(ErrorCode::kIo, "the table answered '{}', which is not understood", shown(answer));
  }

  tl::unexpected<Error> no_answer(const std::string& request, double timeout_s) const {
    std::string why = "nothing came";
    if (!strange_.empty()) why = fmt::format("it sent '{}' instead", shown(strange_));
    if (strange_.empty() && !port_.half_line().empty())
      why = fmt::format("only half a line came: '{}'", shown(port_.half_line()));
    return fail(ErrorCode::kDeviceLost, "the table did not answer '{}' within {:.1f} s ({})",
                request, timeout_s, why);
  }

  /// The text of the answer after "ok".
  Result<std::string> ask(const std::string& request, double timeout_s) {
    const unsigned number = ++number_;
    const std::string text = fmt::format("{} {}", number, request);
    const std::string line = fmt::format("{} *{:02x}", text, checksum(text));
    TURNSCAN_TRY(port_.write(line + "\n"));
    strange_.clear();
    const auto begin = Clock::now();
    for (std::size_t lines = 0; lines < kMaxLines; ++lines) {
      TURNSCAN_ASSIGN(const auto came, port_.read_line(timeout_s - seconds_since(begin)));
      if (!came) return no_answer(request, timeout_s);
      if (*came == line) {
        strange_ = "what it was told (an echo)";
        continue;
      }
      TURNSCAN_ASSIGN(auto answer, answer_in(*came, number));
      if (answer) return *answer;
      if (seconds_since(begin) > timeout_s) return no_answer(request, timeout_s);
    }
    return fail(ErrorCode::kIo, "the table sends without end instead of answering '{}': '{}'",
                request, shown(strange_));
  }

  Result<> ask_for_nothing(const std::string& request, double timeout_s) {
    TURNSCAN_ASSIGN(const std::string answer, ask(request, timeout_s));
    return answer.empty() ? Result<>() : Result<>(not_understood("ok " + answer));
  }

  /// nullopt: not the answer to this request.
  Result<std::optional<std::string>> answer_in(const std::string& line, unsigned number) {
    const auto text = unsealed(line);
    if (!text) {
      strange_ = line;
      return std::optional<std::string>();
    }
    const auto words = text::words_of(*text);
    unsigned of = 0;
    if (words.size() < 2 ||
        std::from_chars(words[0].data(), words[0].data() + words[0].size(), of).ec != std::errc()) {
      strange_ = line;
      return std::optional<std::string>();
    }
    const auto at = static_cast<std::size_t>(words[1].data() - text->data()) + words[1].size();
    std::string rest(text->substr(std::min(text->size(), at + 1)));
    if (of == 0) return unasked(words[1], rest);
    if (of != number) {  // late, or a duplicate
      strange_ = line;
      return std::optional<std::string>();
    }
    if (words[1] == "ok") return rest;
    if (words[1] == "error") return fail(ErrorCode::kIo, "the table refused: {}", shown(rest));
    return not_understood(line);
  }

  /// Handles unsolicited messages: number 0.
  Result<std::optional<std::string>> unasked(std::string_view word, const std::string& rest) const {
    if (word == "ready" && greeted_)
      return fail(ErrorCode::kIo, "the table's board restarted by itself; check its power supply");
    if (word == "alarm") return fail(ErrorCode::kIo, "the table reports: {}", shown(rest));
    return std::optional<std::string>();
  }

  SerialPort& port_;
  double timeout_s_;
  std::string name_;
  unsigned number_ = 0;
  bool greeted_ = false;
  std::string strange_;  ///< the last line received instead of an answer
};

}  // namespace

Result<std::unique_ptr<MotorBoard>> open_text_board(SerialPort& port, const MotorOptions& options) {
  auto board = std::make_unique<TextBoard>(port, options);
  TURNSCAN_TRY(board->hello());
  return std::unique_ptr<MotorBoard>(std::move(board));
}

}  // namespace turnscan::motor
