#pragma once
// Line-based communication over a serial port, or over TCP with a board that has a network.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan::motor {

using Clock = std::chrono::steady_clock;

class SerialPort {
 public:
  /// name: of a serial port, which gets 8 data bits, no parity, 1 stop bit, no flow control, and
  /// whose pending input is discarded; or tcp:HOST:PORT. Fails with kNotFound, kNoPermission,
  /// kDeviceBusy, kInvalidOption, kIo.
  static Result<SerialPort> open(const std::string& name, int baud);
  SerialPort(SerialPort&&) noexcept;
  SerialPort& operator=(SerialPort&&) noexcept;
  ~SerialPort();

  const std::string& name() const;
  /// Fails with kDeviceLost if the port is gone or accepts nothing for half a second.
  Result<> write(std::string_view bytes);
  /// The next line without its terminator ('\n' or '\r'); empty lines are skipped. A line of more
  /// than 240 bytes is split. nullopt: no complete line within the timeout. Fails with kDeviceLost.
  Result<std::optional<std::string>> read_line(double timeout_s);
  /// Bytes received after the last line end.
  const std::string& half_line() const;

 private:
  struct State;
  explicit SerialPort(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace turnscan::motor
