#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <turnscan/core/angles.hpp>
#include <turnscan/core/units.hpp>

namespace turnscan {

namespace {

struct UnitScale {
  std::string_view name;
  double to_si;
};

constexpr std::array<UnitScale, 5> kLengths{
    {{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"um", 1e-6}, {"in", 0.0254}}};
constexpr std::array<UnitScale, 2> kAngles{{{"rad", 1.0}, {"deg", kRadiansPerDegree}}};
constexpr std::array<UnitScale, 3> kTimes{{{"s", 1.0}, {"ms", 1e-3}, {"min", 60.0}}};
constexpr std::array<UnitScale, 3> kSpeeds{
    {{"rad/s", 1.0}, {"deg/s", kRadiansPerDegree}, {"rpm", 6.0 * kRadiansPerDegree}}};

std::span<const UnitScale> units_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::kLength:
      return kLengths;
    case Quantity::kAngle:
      return kAngles;
    case Quantity::kTime:
      return kTimes;
    case Quantity::kAngularSpeed:
      return kSpeeds;
    case Quantity::kNone:
      break;
  }
  return {};
}

std::string names(std::span<const UnitScale> units) {
  std::string text;
  for (const UnitScale& unit : units) {
    if (!text.empty()) text += ", ";
    text += unit.name;
  }
  return text;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

struct Split {
  double value;
  std::string_view rest;  // the text after the number, trimmed
};

// from_chars accepts no leading plus sign, but users write one.
std::optional<Split> split_number(std::string_view text) {
  std::string_view t = trimmed(text);
  if (t.starts_with('+') && !t.starts_with("+-")) t.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(t.data(), t.data() + t.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return Split{value, trimmed(t.substr(static_cast<std::size_t>(end - t.data())))};
}

}  // namespace

Result<double> parse_number(std::string_view text) {
  const auto split = split_number(text);
  if (!split || !split->rest.empty())
    return fail(ErrorCode::kInvalidOption, "'{}' is not a finite number", text);
  return split->value;
}

Result<double> parse_quantity(std::string_view text, Quantity quantity) {
  if (quantity == Quantity::kNone) return parse_number(text);
  const auto units = units_of(quantity);
  const auto split = split_number(text);
  if (!split)
    return fail(ErrorCode::kInvalidOption, "'{}' is not a number with a unit ({})", text,
                names(units));
  const auto [value, unit] = *split;
  if (unit.empty() && value == 0.0) return 0.0;
  for (const UnitScale& u : units) {
    if (unit == u.name) return value * u.to_si;
  }
  if (unit.empty())
    return fail(ErrorCode::kInvalidOption, "'{}' lacks a unit; write one of {}", text,
                names(units));
  return fail(ErrorCode::kInvalidOption, "'{}' has the unknown unit '{}'; write one of {}", text,
              unit, names(units));
}

std::string format_quantity(double value_si, Quantity quantity) {
  switch (quantity) {
    case Quantity::kLength:
      return fmt::format("{:.6g}mm", value_si * 1e3);
    case Quantity::kAngle:
      return fmt::format("{:.6g}deg", value_si / kRadiansPerDegree);
    case Quantity::kTime:
      return fmt::format("{:.6g}s", value_si);
    case Quantity::kAngularSpeed:
      return fmt::format("{:.6g}deg/s", value_si / kRadiansPerDegree);
    case Quantity::kNone:
      break;
  }
  // Integers are written without an exponent; the shortest form would have one from a million on.
  const bool whole = std::abs(value_si) < 1e12 && value_si == std::floor(value_si);
  return whole ? fmt::format("{:.0f}", value_si) : fmt::format("{:.6g}", value_si);
}

Result<double> metres_per(std::string_view unit) {
  for (const UnitScale& u : kLengths) {
    if (unit == u.name) return u.to_si;
  }
  return fail(ErrorCode::kInvalidOption, "'{}' is not a unit of length; write one of {}", unit,
              names(kLengths));
}

}  // namespace turnscan
