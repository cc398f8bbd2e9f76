#pragma once
// A turntable's board behind a pseudo-terminal, which may misbehave.

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace turnscan::testing {

enum class BoardFault {
  kNone,
  kLate,        // answers after a second
  kGarbled,     // answers are damaged
  kStalls,      // says that it turns, and does not
  kDisappears,  // the port goes away
  kWrongReply,  // answers something else
  kHalfLine,    // answers without a line end, then nothing
  kTwice,       // each answer comes twice
  kAlarm,       // reports an alarm of its own, and stops
  kRestarts,    // restarts by itself, and stops
  kEcho,        // sends back what it is told before it answers
  kEndless,     // sends without end
  kSilent,      // answers nothing any more
  kStops        // stops by itself without a word
};

/// Speaks the text protocol or GRBL. The fault begins when the table is told to turn, or at once.
class SimulatedTable {
 public:
  SimulatedTable(bool grbl, BoardFault fault, bool from_start = false)
      : grbl_(grbl), fault_(fault), faulty_(from_start) {
    int slave = -1;
    char name[128] = {};
    if (::openpty(&master_, &slave, name, nullptr, nullptr) != 0) std::abort();
    termios raw{};
    ::tcgetattr(slave, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave, TCSANOW, &raw);
    slave_ = slave;  // stays open: else the terminal is gone before the program opens it
    port_ = name;
    thread_ = std::thread([this] { run(); });
  }
  ~SimulatedTable() {
    ending_ = true;
    thread_.join();
    if (master_ >= 0) ::close(master_);
    if (slave_ >= 0) ::close(slave_);
  }
  SimulatedTable(const SimulatedTable&) = delete;
  SimulatedTable& operator=(const SimulatedTable&) = delete;

  const std::string& port() const { return port_; }
  bool turning() {
    const std::lock_guard lock(mutex_);
    advance();
    return speed_ != 0.0;
  }
  /// Waits: a board that hears nothing stops by itself.
  bool stands_within(double seconds) {
    for (int i = 0; i < int(seconds * 100.0); ++i) {
      if (!turning()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return !turning();
  }
  double angle_deg() {
    const std::lock_guard lock(mutex_);
    advance();
    return angle_;
  }
  bool was_told_to_turn() const { return told_; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr double kWatchdog_s = 2.0;

  static double seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

  void advance() {
    const auto now = Clock::now();
    double dt = seconds(now - moved_);
    moved_ = now;
    if (speed_ != 0.0 && !grbl_ && seconds(now - heard_) > kWatchdog_s) {
      speed_ = 0.0;
      halted_ = true;
    }
    if (speed_ == 0.0) return;
    if (fault_ == BoardFault::kStops && faulty_ && seconds(now - began_) > 0.2) speed_ = 0.0;
    if (fault_ == BoardFault::kStalls && faulty_) dt = 0.0;
    angle_ += speed_ * dt;
    if (fault_ == BoardFault::kStalls && faulty_) return;
    if (aimed_ && (target_ - angle_) * speed_ <= 0.0) {
      angle_ = target_;
      speed_ = 0.0;
    }
  }

  void turn(double deg, double speed, bool aimed) {
    if (speed_ == 0.0 || !aimed_) target_ = angle_;
    target_ += deg;
    aimed_ = aimed;
    speed_ = deg < 0.0 ? -std::abs(speed) : std::abs(speed);
    if (!told_) began_ = Clock::now();
    told_ = true;
    halted_ = false;
  }
  void stand() {
    speed_ = 0.0;
    aimed_ = false;
  }

  void send(const std::string& text) { (void)!::write(master_, text.data(), text.size()); }
  static std::string sealed(const std::string& text) {
    unsigned sum = 0;
    for (const char c : text) sum ^= static_cast<unsigned char>(c);
    char end[8];
    std::snprintf(end, sizeof end, " *%02x", sum);
    return text + end;
  }
  std::string line(const std::string& text) const { return (grbl_ ? text : sealed(text)) + "\r\n"; }

  void answer(const std::string& text) {
    if (!faulty_) return send(line(text));
    switch (fault_) {
      case BoardFault::kLate:
        late_.push_back({Clock::now() + std::chrono::milliseconds(900), line(text)});
        return;
      case BoardFault::kGarbled: {
        std::string bad = line(text);
        for (std::size_t i = 0; i + 2 < bad.size(); i += 2) bad[i] = char(bad[i] ^ 0x55);
        std::replace(bad.begin(), bad.end() - 2, '\n', '~');
        return send(bad);
      }
      case BoardFault::kWrongReply:
        return send(line(grbl_ ? "ja" : text.substr(0, text.find(' ')) + " jawohl"));
      case BoardFault::kHalfLine:
        return send(line(text).substr(0, 1));
      case BoardFault::kTwice:
        return send(line(text) + line(text));
      case BoardFault::kSilent:
        return;
      default:
        return send(line(text));
    }
  }

  void begin_fault() {
    if (faulty_ || fault_ == BoardFault::kNone) return;
    faulty_ = true;
    if (fault_ == BoardFault::kAlarm) {
      stand();
      send(line(grbl_ ? "ALARM:1" : "0 alarm the motor is too hot"));
    }
    if (fault_ == BoardFault::kRestarts) {
      stand();
      send(line(grbl_ ? "Grbl 1.1h ['$' for help]" : "0 ready"));
    }
  }

  void hear(const std::string& text) {
    heard_ = Clock::now();
    if (faulty_ && fault_ == BoardFault::kEcho) send(text + "\r\n");
    grbl_ ? hear_grbl(text) : hear_text(text);
  }

  void hear_text(const std::string& text) {
    const auto star = text.rfind(" *");
    if (star == std::string::npos || sealed(text.substr(0, star)) != text) return;
    unsigned number = 0;
    char word[32] = {};
    double a = 0.0, b = 0.0;
    const int got = std::sscanf(text.c_str(), "%u %31s %lf %lf", &number, word, &a, &b);
    if (got < 2) return;
    const std::string command = word, prefix = std::to_string(number);
    if (command == "hello") return answer(prefix + " ok turnscan-table 1 simulated");
    if (command == "stop") {
      stand();
      halted_ = false;
      return answer(prefix + " ok");
    }
    if (command == "status") {
      char reply[96];
      const char* state = halted_ ? "halted" : (speed_ != 0.0 ? "turning" : "idle");
      std::snprintf(reply, sizeof reply, "%s ok %s %ld.%04ld", prefix.c_str(), state, long(angle_),
                    std::lround(std::abs(angle_ - double(long(angle_))) * 9999.0));
      return answer(reply);
    }
    if (command == "spin" || command == "move") {
      command == "spin" ? turn(number_in(text, 1), number_in(text, 1), false)
                        : turn(number_in(text, 1), number_in(text, 2), true);
      answer(prefix + " ok");
      begin_fault();
      return;
    }
    answer(prefix + " error unknown command");
  }

  /// The n-th number behind the command, with a decimal point whatever the locale.
  static double number_in(const std::string& text, int n) {
    std::size_t at = text.find(' ', text.find(' ') + 1);
    for (int i = 1; i < n; ++i) at = text.find(' ', at + 1);
    return plain_number(text.substr(at + 1));
  }
  static double plain_number(const std::string& text) {
    double value = 0.0, scale = 0.0;
    const bool minus = !text.empty() && text[0] == '-';
    for (std::size_t i = minus ? 1 : 0; i < text.size(); ++i) {
      if (text[i] == '.') {
        scale = 1.0;
      } else if (text[i] >= '0' && text[i] <= '9') {
        value = value * 10.0 + (text[i] - '0');
        scale *= 10.0;
      } else {
        break;
      }
    }
    return (minus ? -value : value) / (scale > 0.0 ? scale : 1.0);
  }

  void hear_grbl(const std::string& text) {
    if (text.rfind("G1X", 0) == 0) {
      turn(plain_number(text.substr(3)), plain_number(text.substr(text.find('F') + 1)) / 60.0,
           true);
      answer("ok");
      begin_fault();
      return;
    }
    answer(text == "G21" || text == "G91" || text == "$X" ? "ok" : "error:20");
  }

  void hear_grbl_byte(char c) {
    if (c == '?') {
      char reply[96];
      const char* state = hold_ ? "Hold:0" : (speed_ != 0.0 ? "Run" : "Idle");
      std::snprintf(reply, sizeof reply, "<%s|MPos:%ld.%03ld,0.000,0.000|FS:0,0>", state,
                    long(angle_), std::lround(std::abs(angle_ - double(long(angle_))) * 999.0));
      answer(reply);
    } else if (c == '!') {
      hold_ = speed_ != 0.0;
      stand();
    } else if (c == 0x18) {
      stand();
      hold_ = false;
      answer("Grbl 1.1h ['$' for help]");
    }
  }

  void take(char c) {
    if (grbl_ && (c == '?' || c == '!' || c == 0x18)) return hear_grbl_byte(c);
    if (!grbl_ && c == '!') {
      stand();
      halted_ = true;
      return;
    }
    if (c != '\n' && c != '\r') {
      input_ += c;
      return;
    }
    if (!input_.empty()) hear(std::exchange(input_, ""));
  }

  void run() {
    while (!ending_) {
      pollfd wait{master_, POLLIN, 0};
      const bool ready = ::poll(&wait, 1, 5) > 0 && (wait.revents & POLLIN) != 0;
      char bytes[256];
      const auto got = ready ? ::read(master_, bytes, sizeof bytes) : 0;
      const std::lock_guard lock(mutex_);
      advance();
      for (ssize_t i = 0; i < got; ++i) take(bytes[i]);
      misbehave();
      if (master_ < 0) return;  // nobody is connected any more
    }
  }

  void misbehave() {
    if (!faulty_) return;
    if (fault_ == BoardFault::kEndless) {
      ::fcntl(master_, F_SETFL, O_NONBLOCK);
      for (int i = 0; i < 20; ++i) send("blah blah blah\r\n");
    }
    if (fault_ == BoardFault::kDisappears) {
      ::close(slave_);
      ::close(master_);
      master_ = slave_ = -1;
    }
    while (!late_.empty() && late_.front().first < Clock::now()) {
      send(late_.front().second);
      late_.erase(late_.begin());
    }
  }

  bool grbl_;
  BoardFault fault_;
  int master_ = -1, slave_ = -1;
  std::string port_, input_;
  std::mutex mutex_;
  std::atomic<bool> ending_ = false, faulty_, told_ = false;
  double angle_ = 0.0, speed_ = 0.0, target_ = 0.0;
  bool aimed_ = false, halted_ = false, hold_ = false;
  Clock::time_point moved_ = Clock::now(), heard_ = Clock::now(), began_ = Clock::now();
  std::vector<std::pair<Clock::time_point, std::string>> late_;
  std::thread thread_;
};

}  // namespace turnscan::testing
