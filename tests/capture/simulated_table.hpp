#pragma once
// A turntable's board behind a pseudo-terminal, which may misbehave.

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <pty.h>
#include <sys/socket.h>
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
  kStops,       // stops by itself without a word
  kDamagesOne,  // Marlin: hears a damaged line once, and asks for it again
  kBusy,        // Marlin: says that it is busy, once, and answers after that
  kBlind,       // Marlin: built without M114_REALTIME, it only says where its motion ends
  kNoLimits,    // Marlin: built without limits, it does not know M211
  kTalkative    // Marlin: lists a hundred settings before its first answer
};

enum class BoardKind {
  kText,
  kGrbl,
  kGrblHal,
  kFluidNc,  // behind TCP, as all that are called ...Tcp
  kMarlin,
  kMarlinTcp
};

/// The fault begins when the table is told to turn, or at once.
class SimulatedTable {
 public:
  SimulatedTable(BoardKind kind, BoardFault fault, bool from_start = false)
      : kind_(kind), fault_(fault), faulty_(from_start) {
    if (kind == BoardKind::kFluidNc || kind == BoardKind::kMarlinTcp)
      listen_at_port();
    else
      open_terminal();
    thread_ = std::thread([this] { run(); });
  }
  ~SimulatedTable() {
    ending_ = true;
    thread_.join();
    for (const int descriptor : {master_, slave_, listening_})
      if (descriptor >= 0) ::close(descriptor);
  }
  SimulatedTable(const SimulatedTable&) = delete;
  SimulatedTable& operator=(const SimulatedTable&) = delete;

 private:
  void open_terminal() {
    int slave = -1;
    char name[128] = {};
    if (::openpty(&master_, &slave, name, nullptr, nullptr) != 0) std::abort();
    termios raw{};
    ::tcgetattr(slave, &raw);
    ::cfmakeraw(&raw);
    ::tcsetattr(slave, TCSANOW, &raw);
    slave_ = slave;  // stays open: else the terminal is gone before the program opens it
    port_ = name;
  }
  void listen_at_port() {
    listening_ = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof at;
    if (::bind(listening_, reinterpret_cast<sockaddr*>(&at), size) != 0 ||
        ::listen(listening_, 1) != 0 ||
        ::getsockname(listening_, reinterpret_cast<sockaddr*>(&at), &size) != 0)
      std::abort();
    port_ = "tcp:127.0.0.1:" + std::to_string(ntohs(at.sin_port));
  }

 public:
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
    if (speed_ != 0.0 && text_() && seconds(now - heard_) > kWatchdog_s) {
      speed_ = 0.0;
      halted_ = true;
    }
    if (speed_ == 0.0) return;
    if (fault_ == BoardFault::kStops && faulty_ && seconds(now - began_) > 0.2) {
      speed_ = 0.0;
      target_ = angle_;
    }
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
    target_ = angle_;
  }

  bool text_() const { return kind_ == BoardKind::kText; }
  bool marlin() const { return kind_ == BoardKind::kMarlin || kind_ == BoardKind::kMarlinTcp; }
  /// The line with which the board starts.
  std::string greeting() const {
    switch (kind_) {
      case BoardKind::kText:
        return "0 ready";
      case BoardKind::kGrbl:
        return "Grbl 1.1h ['$' for help]";
      case BoardKind::kGrblHal:
        return "GrblHAL 1.1f ['$' or '$HELP' for help]";
      case BoardKind::kFluidNc:
        return "Grbl 3.7 [FluidNC v3.7.8 (wifi) '$' for help]";
      default:
        return "start";
    }
  }

  void send(const std::string& text) {
    // A socket that the program closed must not end the tests.
    if (listening_ >= 0)
      (void)!::send(master_, text.data(), text.size(), MSG_NOSIGNAL);
    else
      (void)!::write(master_, text.data(), text.size());
  }
  static std::string sealed(const std::string& text) {
    unsigned sum = 0;
    for (const char c : text) sum ^= static_cast<unsigned char>(c);
    char end[8];
    std::snprintf(end, sizeof end, " *%02x", sum);
    return text + end;
  }
  std::string line(const std::string& text) const {
    return (text_() ? sealed(text) : text) + "\r\n";
  }

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
        return send(line(text_() ? text.substr(0, text.find(' ')) + " jawohl" : "ja"));
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
      send(line(text_()    ? "0 alarm the motor is too hot"
                : marlin() ? "Error:Printer halted. kill() called!"
                           : "ALARM:1"));
    }
    if (fault_ == BoardFault::kRestarts) {
      stand();
      send(line(greeting()));
    }
  }

  void hear(const std::string& text) {
    heard_ = Clock::now();
    if (faulty_ && fault_ == BoardFault::kEcho) send(text + "\r\n");
    text_() ? hear_text(text) : marlin() ? hear_marlin(text) : hear_grbl(text);
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
    if (text == "$X") {
      if (locked_) send(line("[MSG:Caution: Unlocked]"));
      locked_ = false;
      return answer("ok");
    }
    if (locked_) return answer("error:9");
    if (text.rfind("G1X", 0) == 0) {
      turn(plain_number(text.substr(3)), plain_number(text.substr(text.find('F') + 1)) / 60.0,
           true);
      answer("ok");
      begin_fault();
      return;
    }
    answer(text == "G21" || text == "G91" ? "ok" : "error:20");
  }

  void hear_grbl_byte(char c) {
    if (c == '?') {
      char reply[96];
      const char* state = locked_ ? "Alarm" : hold_ ? "Hold:0" : (speed_ != 0.0 ? "Run" : "Idle");
      std::snprintf(reply, sizeof reply, "<%s|MPos:%s,0.000,0.000|%sFS:0,0>", state,
                    decimal(angle_, 3).c_str(), kind_ == BoardKind::kGrblHal ? "Bf:100,1023|" : "");
      answer(reply);
    } else if (c == '!') {
      hold_ = speed_ != 0.0;
      stand();
    } else if (c == 0x18) {
      // These lock themselves when they are reset in the middle of a motion.
      if (kind_ != BoardKind::kGrbl && (hold_ || speed_ != 0.0)) locked_ = true;
      stand();
      hold_ = false;
      answer(greeting());
      if (locked_) send(line("[MSG:'$H'|'$X' to unlock]"));
    }
  }

  /// "N3 G91*29": numbered, with a checksum; or as it is.
  void hear_marlin(const std::string& text) {
    std::string command = text;
    if (text[0] == 'N') {
      const auto star = text.rfind('*');
      unsigned sum = 0, given = 0;
      int number = -1;
      for (std::size_t i = 0; i < std::min(star, text.size()); ++i)
        sum ^= static_cast<unsigned char>(text[i]);
      const bool whole = star != std::string::npos &&
                         std::sscanf(text.c_str() + star + 1, "%u", &given) == 1 &&
                         std::sscanf(text.c_str() + 1, "%d", &number) == 1;
      command = text.substr(std::min(text.size(), text.find(' ') + 1));
      if (whole) command = command.substr(0, command.rfind('*'));
      const bool restarts = command.rfind("M110", 0) == 0;
      const bool damaged = fault_ == BoardFault::kDamagesOne && command.rfind("G1", 0) == 0 &&
                           std::exchange(damage_, false);
      if (!whole || sum != given || damaged || (number != last_ + 1 && !restarts)) {
        answer("Error:checksum mismatch, Last Line: " + std::to_string(last_));
        answer("Resend: " + std::to_string(last_ + 1));
        return answer("ok");
      }
      last_ = number;
    }
    if (command.rfind("G1X", 0) == 0) {
      turn(plain_number(command.substr(3)),
           plain_number(command.substr(command.find('F') + 1)) / 60.0, true);
      if (fault_ == BoardFault::kBusy && std::exchange(damage_, false)) {
        send(line("echo:busy: processing"));
        late_.push_back({Clock::now() + std::chrono::milliseconds(700), line("ok")});
        return;
      }
      answer("ok");
      begin_fault();
      return;
    }
    if (fault_ == BoardFault::kTalkative && std::exchange(damage_, false))
      for (int i = 0; i < 100; ++i) send(line("echo:  M421 I0 J" + std::to_string(i) + " Z0.0"));
    const bool asks_end = command == "M114";
    if (asks_end || command == "M114 R") {
      // Distance and steps are of the same place: of the end of the motion, unless R is understood.
      const bool end = asks_end || fault_ == BoardFault::kBlind;
      const double x = end && speed_ != 0.0 ? target_ : angle_;
      answer("X:" + decimal(x, 2) + " Y:0.00 Z:0.00 E:0.00 Count X:" +
             std::to_string(std::lround(x * kStepsPerUnit)) + " Y:0 Z:0");
    } else if (command == "M410")
      stand();
    else if (command == "M92")
      send(line("echo:  M92 X80.00 Y80.00 Z400.00 E93.00"));
    else if (command != "G21" && command != "G91" && command != "M110 N0" &&
             (command != "M211 S0" || fault_ == BoardFault::kNoLimits))
      answer("echo:Unknown command: \"" + command + "\"");
    answer("ok");
  }

  /// With a decimal point whatever the locale.
  static std::string decimal(double value, int digits) {
    const long scale = std::lround(std::pow(10.0, digits));
    const long units = std::lround(std::abs(value) * double(scale));
    std::string after = std::to_string(units % scale);
    after.insert(0, std::size_t(digits) - after.size(), '0');
    return (value < 0.0 ? "-" : "") + std::to_string(units / scale) + "." + after;
  }

  void take(char c) {
    if (!text_() && !marlin() && (c == '?' || c == '!' || c == 0x18)) return hear_grbl_byte(c);
    if (text_() && c == '!') {
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
    while (!ending_ && master_ < 0) {
      pollfd wait{listening_, POLLIN, 0};
      if (::poll(&wait, 1, 5) > 0) master_ = ::accept(listening_, nullptr, nullptr);
    }
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
    while (!late_.empty() && late_.front().first < Clock::now()) {
      send(late_.front().second);
      late_.erase(late_.begin());
    }
    if (!faulty_) return;
    if (fault_ == BoardFault::kEndless) {
      ::fcntl(master_, F_SETFL, O_NONBLOCK);
      for (int i = 0; i < 20; ++i) send("blah blah blah\r\n");
    }
    if (fault_ == BoardFault::kDisappears) {
      for (int* const descriptor : {&slave_, &master_}) {
        if (*descriptor >= 0) ::close(*descriptor);
        *descriptor = -1;
      }
    }
  }

  static constexpr double kStepsPerUnit = 80.0;

  BoardKind kind_;
  BoardFault fault_;
  int master_ = -1, slave_ = -1, listening_ = -1;
  int last_ = 0;        // number of a line
  bool damage_ = true;  // not done yet
  std::string port_, input_;
  std::mutex mutex_;
  std::atomic<bool> ending_ = false, faulty_, told_ = false;
  double angle_ = 0.0, speed_ = 0.0, target_ = 0.0;
  bool aimed_ = false, halted_ = false, hold_ = false, locked_ = false;
  Clock::time_point moved_ = Clock::now(), heard_ = Clock::now(), began_ = Clock::now();
  std::vector<std::pair<Clock::time_point, std::string>> late_;
  std::thread thread_;
};

}  // namespace turnscan::testing
