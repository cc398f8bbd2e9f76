#pragma once
// Dates as files have them: ISO 8601, in UTC, to the second ("2026-11-24T08:30:00Z").

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace turnscan {

/// Seconds since the beginning of 1970, as this machine's clock has them.
std::int64_t utc_now_s();

/// The date of so many seconds since the beginning of 1970; of the years 0 to 9999.
std::string utc_text(std::int64_t seconds);

/// The seconds of a date as utc_text() writes it; a fraction of a second is left out. nullopt of
/// anything else, also of a date that there is not (30 February) and of another time zone.
std::optional<std::int64_t> utc_seconds(std::string_view text);

/// How long `seconds` are, for people, in the unit that fits: "40 minutes", "3 days", "2 years".
std::string duration_text(double seconds);

}  // namespace turnscan
