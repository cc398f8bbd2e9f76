#pragma once
// Formats measured values with the digits they are known to.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <string_view>
#include <turnscan/core/units.hpp>

namespace turnscan {

/// "12.30 mm" for two decimals; "not known" for a value that is not finite.
inline std::string figure_text(double value, int decimals, std::string_view unit) {
  if (!std::isfinite(value)) return "not known";
  return fmt::format("{:.{}f} {}", value, decimals, unit);
}

/// A length as formatted by format_quantity(), but no finer than 0.01 mm, or 0.001 mm below a
/// millimetre.
inline std::string length_text(double metres) {
  if (!std::isfinite(metres)) return "not known";
  const double steps_per_mm = std::abs(metres) < 1e-3 ? 1e3 : 1e2;
  const double mm = std::round(metres * 1e3 * steps_per_mm) / steps_per_mm;
  return format_quantity(mm == 0.0 ? 0.0 : mm * 1e-3, Quantity::kLength);  // avoids a negative zero
}

}  // namespace turnscan
