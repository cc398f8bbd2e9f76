// Transfers bytes through termios, because libserialport only opens what the system lists as a
// serial port: not pseudo-terminals, and thus neither socat's nor those of our tests. The list of
// ports and their descriptions comes from libserialport.

#include <fcntl.h>
#include <libserialport.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <deque>
#include <system_error>
#include <turnscan/capture/motor/serial_port.hpp>

namespace turnscan::motor {

namespace {

constexpr std::size_t kLongestLine = 240;
constexpr int kWriteTimeout_ms = 500;
/// Time for the rest of a line that has begun.
constexpr auto kLongestTail = std::chrono::milliseconds(300);
constexpr int kConnectTimeout_ms = 3000;
constexpr std::string_view kNetwork = "tcp:";

/// "/dev/ttyUSB0 (CP2102 USB to UART Bridge)" for each port; "none" if there are none.
std::string ports_there() {
  std::string text;
  sp_port** ports = nullptr;
  if (sp_list_ports(&ports) != SP_OK) return "none";
  for (int i = 0; ports[i] != nullptr && i < 8; ++i) {
    const char* about = sp_get_port_description(ports[i]);
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", sp_get_port_name(ports[i]),
                        about != nullptr ? fmt::format(" ({})", about) : std::string());
  }
  sp_free_port_list(ports);
  return text.empty() ? "none" : text;
}

tl::unexpected<Error> refusal(const std::string& name, int error) {
  if (error == ENOENT || error == ENODEV || error == ENXIO || error == ENOTDIR)
    return fail_at(name, ErrorCode::kNotFound,
                   "there is no such serial port (there are: {}); plug the table in, or give "
                   "another name",
                   ports_there());
  if (error == EACCES || error == EPERM)
    return fail_at(name, ErrorCode::kNoPermission,
                   "this user may not use the serial port; add the user to the group dialout and "
                   "log in again");
  if (error == EBUSY || error == EWOULDBLOCK)
    return fail_at(name, ErrorCode::kDeviceBusy,
                   "another program uses the serial port; close that program");
  return fail_at(name, ErrorCode::kIo, "cannot open the serial port: {}; is it one?",
                 std::generic_category().message(error));
}

}  // namespace

struct SerialPort::State {
  std::string name;
  int descriptor = -1;
  bool network = false;
  std::string half;
  std::deque<std::string> lines;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (descriptor >= 0) ::close(descriptor);
  }

  tl::unexpected<Error> lost() const {
    return fail_at(name, ErrorCode::kDeviceLost,
                   "the turntable's {} is gone; check {} and power of the table",
                   network ? "connection" : "serial port", network ? "network" : "cable");
  }

  void take(std::string_view bytes) {
    for (const char c : bytes) {
      const bool end = c == '\n' || c == '\r';
      if (!end) half += c;
      if ((end && !half.empty()) || half.size() >= kLongestLine) {
        lines.push_back(std::move(half));
        half.clear();
      }
    }
  }

  /// False: nothing arrived.
  Result<bool> receive(int timeout_ms) {
    pollfd wait{descriptor, POLLIN, 0};
    const int ready = ::poll(&wait, 1, timeout_ms);
    if (ready < 0 && errno != EINTR) return lost();
    if (ready <= 0) return false;
    std::array<char, 512> bytes{};
    const auto got = ::read(descriptor, bytes.data(), bytes.size());
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return false;
    // Readable without data: the other end is closed.
    if (got <= 0) return lost();
    take(std::string_view(bytes.data(), static_cast<std::size_t>(got)));
    return true;
  }
};

SerialPort::SerialPort(std::unique_ptr<State> state) : state_(std::move(state)) {}
SerialPort::SerialPort(SerialPort&&) noexcept = default;
SerialPort& SerialPort::operator=(SerialPort&&) noexcept = default;
SerialPort::~SerialPort() = default;

const std::string& SerialPort::name() const { return state_->name; }
const std::string& SerialPort::half_line() const { return state_->half; }

namespace {

/// Raw mode, 8N1, no flow control. False: not a serial port, or the speed is not supported.
bool make_raw(int descriptor, int baud) {
  termios mode{};
  if (::tcgetattr(descriptor, &mode) != 0) return false;
  ::cfmakeraw(&mode);
  mode.c_cflag |= CLOCAL | CREAD;
  mode.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  if (::cfsetspeed(&mode, static_cast<speed_t>(baud)) != 0) return false;
  return ::tcsetattr(descriptor, TCSANOW, &mode) == 0;
}

}  // namespace

namespace {

/// Connects without waiting for longer than kConnectTimeout_ms; -1 and errno if that fails.
int connected(const addrinfo& at) {
  const int descriptor =
      ::socket(at.ai_family, at.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, at.ai_protocol);
  if (descriptor < 0) return -1;
  int error = ::connect(descriptor, at.ai_addr, at.ai_addrlen) == 0 ? 0 : errno;
  if (error == EINPROGRESS) {
    pollfd wait{descriptor, POLLOUT, 0};
    socklen_t size = sizeof error;
    if (::poll(&wait, 1, kConnectTimeout_ms) <= 0)
      error = ETIMEDOUT;
    else if (::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size) != 0)
      error = errno;
  }
  if (error == 0) {
    const int on = 1;  // commands are short, and late ones are faults
    (void)::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return descriptor;
  }
  ::close(descriptor);
  errno = error;
  return -1;
}

/// A descriptor. Fails with kInvalidOption, kNotFound and kIo.
Result<int> connect_to(const std::string& name) {
  const std::string_view place = std::string_view(name).substr(kNetwork.size());
  const auto colon = place.rfind(':');
  if (colon == std::string_view::npos || colon == 0 || colon + 1 == place.size())
    return fail_at(name, ErrorCode::kInvalidOption,
                   "a board in the network is named tcp:HOST:PORT, such as tcp:192.168.0.20:23");
  std::string host(place.substr(0, colon));
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* list = nullptr;
  const int found =
      ::getaddrinfo(host.c_str(), std::string(place.substr(colon + 1)).c_str(), &hints, &list);
  if (found != 0)
    return fail_at(name, ErrorCode::kNotFound, "there is no such board: {}; check its name",
                   ::gai_strerror(found));
  int descriptor = -1;
  for (const addrinfo* at = list; at != nullptr && descriptor < 0; at = at->ai_next)
    descriptor = connected(*at);
  const int error = errno;
  ::freeaddrinfo(list);
  if (descriptor < 0)
    return fail_at(name, ErrorCode::kIo,
                   "cannot connect to the board: {}; check its address, and that no other program "
                   "uses it",
                   std::generic_category().message(error));
  return descriptor;
}

}  // namespace

Result<SerialPort> SerialPort::open(const std::string& name, int baud) {
  if (name.starts_with(kNetwork)) {
    auto state = std::make_unique<State>();
    state->name = name;
    state->network = true;
    TURNSCAN_ASSIGN(state->descriptor, connect_to(name));
    return SerialPort(std::move(state));
  }
  auto state = std::make_unique<State>();
  state->name = name;
  state->descriptor = ::open(name.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (state->descriptor < 0) return refusal(name, errno);
  if (::isatty(state->descriptor) == 0) return refusal(name, ENOTTY);
  if (::flock(state->descriptor, LOCK_EX | LOCK_NB) != 0) return refusal(name, errno);
  (void)::ioctl(state->descriptor, TIOCEXCL);
  if (!make_raw(state->descriptor, baud))
    return fail_at(name, ErrorCode::kIo,
                   "the serial port does not work at {} baud; try another --motor-baud", baud);
  ::tcflush(state->descriptor, TCIOFLUSH);
  return SerialPort(std::move(state));
}

Result<> SerialPort::write(std::string_view bytes) {
  while (!bytes.empty()) {
    pollfd wait{state_->descriptor, POLLOUT, 0};
    const int ready = ::poll(&wait, 1, kWriteTimeout_ms);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 || (wait.revents & POLLOUT) == 0) return state_->lost();
    const auto done = state_->network
                          ? ::send(state_->descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL)
                          : ::write(state_->descriptor, bytes.data(), bytes.size());
    if (done < 0 && errno != EAGAIN && errno != EINTR) return state_->lost();
    if (done > 0) bytes.remove_prefix(static_cast<std::size_t>(done));
  }
  return {};
}

Result<std::optional<std::string>> SerialPort::read_line(double timeout_s) {
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(std::max(0.0, timeout_s)));
  while (state_->lines.empty()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    TURNSCAN_ASSIGN(const bool came,
                    state_->receive(static_cast<int>(std::max<long>(0, left.count() + 1))));
    if (!came && Clock::now() >= end) return std::optional<std::string>();
    // Line ends alone may come for ever.
    if (state_->lines.empty() && Clock::now() >= end + kLongestTail)
      return std::optional<std::string>();
  }
  std::string line = std::move(state_->lines.front());
  state_->lines.pop_front();
  return line;
}

}  // namespace turnscan::motor
