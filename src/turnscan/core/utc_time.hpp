#pragma once
// Dates as in files: ISO 8601, in UTC, to the second ("2026-11-24T08:30:00Z").

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace turnscan {

/// Seconds since the beginning of 1970 by this machine's clock.
std::int64_t utc_now_s();

/// The date at this number of seconds since the beginning of 1970; years 0 to 9999.
std::string utc_text(std::int64_t seconds);

/// The seconds of a date as formatted by utc_text(); fractions of a second are dropped. nullopt for
/// anything else, including dates that do not exist (30 February) and other time zones.
std::optional<std::int64_t> utc_seconds(std::string_view text);

/// Human-readable duration in a suitable unit: "40 minutes", "3 days", "2 years".
std::string duration_text(double seconds);

}  // namespace turnscan
