#pragma once
// Lines over a serial port.

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
  /// 8 data bits, no parity, 1 stop bit, no flow control. What was waiting is thrown away. Fails
  /// with kNotFound, kNoPermission, kDeviceBusy, kIo.
  static Result<SerialPort> open(const std::string& name, int baud);
  SerialPort(SerialPort&&) noexcept;
  SerialPort& operator=(SerialPort&&) noexcept;
  ~SerialPort();

  const std::string& name() const;
  /// Fails with kDeviceLost when the port is gone or takes nothing for half a second.
  Result<> write(std::string_view bytes);
  /// The next line without its end ('\n' or '\r'); empty lines are left out. A line of more than
  /// 240 bytes is cut into several. nullopt: none ended within the timeout. Fails with kDeviceLost.
  Result<std::optional<std::string>> read_line(double timeout_s);
  /// What came after the last line end.
  const std::string& half_line() const;

 private:
  struct State;
  explicit SerialPort(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace turnscan::motor
