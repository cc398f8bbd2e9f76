// Sources: the interface description of Grbl 1.1 (doc/markdown/interface.md and commands.md in its
// repository; 0.9 differs only in the status line), grblHAL's core (protocol.c, report.c),
// FluidNC's wiki (serial protocol, telnet), Marlin 2's G-code reference (M110, M114, M410) and its
// queue.cpp.

#include <algorithm>
#include <array>
#include <turnscan/capture/motor/gcode_dialect.hpp>
#include <turnscan/core/units.hpp>

namespace turnscan::motor {

namespace {

std::optional<double> number_behind(std::string_view line, std::string_view what) {
  const auto at = line.find(what);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view rest = line.substr(at + what.size());
  const auto number = parse_number(rest.substr(0, rest.find_first_of(",|> ")));
  return number ? std::optional(*number) : std::nullopt;
}

/// "<Idle|MPos:1.000,0.000,0.000|FS:0,0>" or "<Idle,MPos:1.000,0.000,0.000,WPos:...>"
std::optional<GcodeStatus> grbl_status(std::string_view line, double /*steps_per_unit*/) {
  if (line.size() < 3 || line.front() != '<' || line.back() != '>') return std::nullopt;
  line = line.substr(1, line.size() - 2);
  auto x = number_behind(line, "MPos:");
  if (!x) x = number_behind(line, "WPos:");
  if (!x) return std::nullopt;
  return GcodeStatus{std::string(line.substr(0, line.find_first_of("|,"))), *x};
}

/// "X:10.00 Y:0.00 Z:0.00 E:0.00 Count X:800 Y:0 Z:0": to M114 R, if Marlin was built with
/// M114_REALTIME, the steps done so far; to M114 those at the end of the queued motion.
std::optional<GcodeStatus> marlin_status(std::string_view line, double steps_per_unit) {
  if (!line.starts_with("X:") || !(steps_per_unit > 0.0)) return std::nullopt;
  const auto count = number_behind(line, "Count X:");
  if (!count) return std::nullopt;
  return GcodeStatus{"Idle", *count / steps_per_unit};
}

constexpr std::array<std::string_view, 2> kGrblSetup{"G21", "G91"};
constexpr std::array<std::string_view, 1> kGrblRefusals{"error"};
// M92 reports the steps per unit, by which M114 counts.
constexpr std::array<std::string_view, 3> kMarlinSetup{"G21", "G91", "M92"};
constexpr std::array<std::string_view, 2> kMarlinRefusals{"Error:", "echo:Unknown command"};

constexpr GcodeDialect grbl_like(MotorProtocol protocol, std::string_view name,
                                 std::string_view greeting, std::string_view greeting_part) {
  return {protocol,   name, greeting, greeting_part, "?",        "", false, "!", "\x18", "$X",
          kGrblSetup, "",   "ALARM",  kGrblRefusals, grbl_status};
}

constexpr std::array kDialects{
    grbl_like(MotorProtocol::kFluidNc, "FluidNC", "Grbl ", "[FluidNC"),
    grbl_like(MotorProtocol::kGrbl, "GRBL", "Grbl ", "for help]"),
    grbl_like(MotorProtocol::kGrbl, "GRBL", "Horus ", "for help]"),
    grbl_like(MotorProtocol::kGrblHal, "grblHAL", "GrblHAL ", "for help]"),
    // Without M211 it would not turn beyond its axis' end.
    GcodeDialect{MotorProtocol::kMarlin, "Marlin", "start", "", "M114 R", "M114", true, "M410\n",
                 "", "", kMarlinSetup, "M211 S0", "Error:Printer halted", kMarlinRefusals,
                 marlin_status},
};

}  // namespace

std::span<const GcodeDialect> gcode_dialects() { return kDialects; }

const GcodeDialect* greeted_by(std::string_view line) {
  const auto found = std::find_if(kDialects.begin(), kDialects.end(), [&](const auto& dialect) {
    // A word of its own: "start", but not "starting".
    return dialect.greeting_part.empty()
               ? line == dialect.greeting
               : line.starts_with(dialect.greeting) &&
                     line.find(dialect.greeting_part) != std::string_view::npos;
  });
  return found == kDialects.end() ? nullptr : &*found;
}

const GcodeDialect* dialect_of(MotorProtocol protocol) {
  const auto found = std::find_if(kDialects.begin(), kDialects.end(), [&](const auto& dialect) {
    return dialect.protocol == protocol;
  });
  return found == kDialects.end() ? nullptr : &*found;
}

std::optional<double> steps_in(std::string_view line) {
  const auto steps = number_behind(line, "M92 X");
  return steps && *steps > 0.0 ? steps : std::nullopt;
}

}  // namespace turnscan::motor
