#pragma once
// What differs between the firmwares that turn a table by G-code.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/capture/motor/motor.hpp>

namespace turnscan::motor {

struct GcodeStatus {
  std::string state;  ///< as GRBL names it: "Idle", "Run", "Hold:0", "Alarm", ...
  double x = 0.0;
};

struct GcodeDialect {
  MotorProtocol protocol;
  std::string_view name;
  /// The line with which a board starts begins with the first, and contains the second.
  std::string_view greeting, greeting_part;
  /// Asks for state and position. If commands are numbered lines this is one, answered by "ok" as
  /// well; else a single byte, answered by the status alone.
  std::string_view query;
  /// Asks where the queued motion ends: the table stands if it is there. Empty: the status says
  /// whether it stands.
  std::string_view query_end;
  /// Commands are numbered and have a checksum: the board asks for those that were damaged.
  bool numbered;
  /// Stops the table at once. Then reset, if there is one, discards the rest of the motion, and is
  /// answered by the greeting.
  std::string_view hold, reset;
  std::string_view unlock;                  ///< leaves the state "Alarm"
  std::span<const std::string_view> setup;  ///< millimetres, relative distances
  std::string_view no_limits;               ///< boards without limits may refuse it; empty: none
  std::string_view alarm;                   ///< how a message begins after which nothing is valid
  std::span<const std::string_view> refusals;  ///< how an answer to a command begins
  /// nullopt: no status. steps_per_unit: of axis X, as the board said; 0: it did not.
  std::optional<GcodeStatus> (*status_in)(std::string_view line, double steps_per_unit);
};

std::span<const GcodeDialect> gcode_dialects();
/// The dialect of the board that starts with this line; nullptr: none.
const GcodeDialect* greeted_by(std::string_view line);
/// The first of its protocol; kAuto: nullptr.
const GcodeDialect* dialect_of(MotorProtocol protocol);

/// "echo:  M92 X80.00 Y80.00 ...": Marlin's steps per unit of axis X.
std::optional<double> steps_in(std::string_view line);

}  // namespace turnscan::motor
