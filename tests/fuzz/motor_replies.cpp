// The input is what a turntable's board sends. Its first byte chooses the protocol; then come
// lines. One that begins with '~' gets the number of the next request and the checksum of the text
// protocol.

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <turnscan/capture/motor/motor_board.hpp>

#include "tests/fuzz/fuzz_target.hpp"

namespace {

using namespace turnscan;

constexpr double kMillionTurns_deg = 3.6e8;

/// Both ends of a pseudo terminal.
class Terminal {
 public:
  Terminal() : board_(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (board_ >= 0 && ::grantpt(board_) == 0 && ::unlockpt(board_) == 0) {
      char name[64] = "";
      if (::ptsname_r(board_, name, sizeof name) == 0) name_ = name;
    }
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() {
    if (board_ >= 0) ::close(board_);
  }
  const std::string& name() const { return name_; }
  /// As much as the terminal holds.
  void send(std::string_view bytes) const {
    [[maybe_unused]] const auto sent = ::write(board_, bytes.data(), bytes.size());
  }

 private:
  int board_;
  std::string name_;
};

std::string sealed(unsigned number, std::string_view text) {
  const std::string line = fmt::format("{} {}", number, text);
  unsigned sum = 0;
  for (const char c : line) sum ^= static_cast<unsigned char>(c);
  return fmt::format("{} *{:02x}", line, sum);
}

std::string replies_in(std::string_view bytes) {
  std::string out;
  unsigned number = 0;
  while (!bytes.empty()) {
    const std::string_view line = bytes.substr(0, bytes.find('\n'));
    bytes.remove_prefix(std::min(bytes.size(), line.size() + 1));
    out += line.starts_with('~') ? sealed(++number, line.substr(1)) : std::string(line);
    out += '\n';
  }
  return out;
}

/// Whether the call succeeded; a failure is one of those that boards have.
template <class T>
bool fine(const Result<T>& result) {
  if (result) return true;
  if (result.error().code != ErrorCode::kDeviceLost && result.error().code != ErrorCode::kIo)
    std::abort();
  return false;
}

}  // namespace

TURNSCAN_FUZZ_TARGET(motor_replies) {
  if (size == 0) return 0;
  const Terminal terminal;
  auto port = motor::SerialPort::open(terminal.name(), 115200);
  if (!port) std::abort();
  terminal.send(replies_in({reinterpret_cast<const char*>(data) + 1, size - 1}));
  MotorOptions options;
  options.timeout_s = 0.02;
  auto board =
      data[0] == 't'
          ? motor::open_text_board(*port, options)
          : motor::open_gcode_board(
                *port, options,
                *motor::dialect_of(data[0] == 'm' ? MotorProtocol::kMarlin : MotorProtocol::kGrbl),
                {});
  if (!fine(board)) return 0;
  const auto status = (*board)->status();
  if (fine(status) && !(std::abs(status->angle_deg) <= kMillionTurns_deg)) std::abort();
  if (fine((*board)->spin(10.0)) && status) fine((*board)->keep_spinning(status->angle_deg));
  fine((*board)->move(5.0, 10.0));
  fine((*board)->status());
  fine((*board)->halt());
  return 0;
}
