#pragma once
// Values with units, as people write them: "1.5mm", "17deg", "10.4478deg/s". Inside turnscan all
// quantities are SI (metres, radians, seconds); these functions are the border.

#include <string>
#include <string_view>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Nothing that is read lies further from its origin, in metres: 1000 km. Beyond it 32-bit floats
/// cannot tell a table from a house, and libraries that cast rays overflow.
inline constexpr double kMaxDistance_m = 1e6;

enum class Quantity { kNone, kLength, kAngle, kTime, kAngularSpeed };

/// Reads a finite number with a unit of the quantity and returns it in SI units. Lengths: um, mm,
/// cm, m, in; angles: deg, rad; times: ms, s, min; angular speeds: deg/s, rad/s, rpm. A missing
/// unit is refused unless the value is 0 or the quantity is kNone. Independent of the locale.
Result<double> parse_quantity(std::string_view text, Quantity quantity);

/// Shortest text that reads back as the same value to 6 digits, in the unit people use:
/// mm, deg, s, deg/s.
std::string format_quantity(double value_si, Quantity quantity);

/// Scale to metres of a unit of length ("mm" -> 0.001); fails on anything else.
Result<double> metres_per(std::string_view unit);

/// Locale-independent text to number; the whole text must be one finite number.
Result<double> parse_number(std::string_view text);

}  // namespace turnscan
