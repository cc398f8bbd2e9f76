#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <turnscan/core/utc_time.hpp>

namespace turnscan {

namespace {

namespace chrono = std::chrono;

/// Parses digits from a position on; -1 if there are other characters.
int number_at(std::string_view text, std::size_t at, std::size_t digits) {
  int value = 0;
  for (std::size_t i = at; i < at + digits; ++i) {
    if (text[i] < '0' || text[i] > '9') return -1;
    value = 10 * value + (text[i] - '0');
  }
  return value;
}

/// Checks the text after the seconds: nothing, or a point and digits, then Z.
bool ends_well(std::string_view rest) {
  if (rest.empty() || rest.back() != 'Z') return false;
  rest.remove_suffix(1);
  if (rest.empty()) return true;
  return rest.size() > 1 && rest[0] == '.' &&
         rest.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

struct Unit {
  double seconds;
  const char* name;
};
constexpr std::array<Unit, 6> kUnits{{{365.25 * 86400.0, "year"},
                                      {30.44 * 86400.0, "month"},
                                      {86400.0, "day"},
                                      {3600.0, "hour"},
                                      {60.0, "minute"},
                                      {1.0, "second"}}};

}  // namespace

std::int64_t utc_now_s() {
  return chrono::duration_cast<chrono::seconds>(chrono::system_clock::now().time_since_epoch())
      .count();
}

std::string utc_text(std::int64_t seconds) {
  const chrono::sys_seconds time{chrono::seconds(seconds)};
  const auto day = chrono::floor<chrono::days>(time);
  const chrono::year_month_day date(day);
  const chrono::hh_mm_ss clock(time - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", int(date.year()),
                     unsigned(date.month()), unsigned(date.day()), clock.hours().count(),
                     clock.minutes().count(), clock.seconds().count());
}

std::optional<std::int64_t> utc_seconds(std::string_view text) {
  constexpr std::size_t kClock = 19;  // characters before the fraction
  if (text.size() <= kClock || text[4] != '-' || text[7] != '-' || text[10] != 'T' ||
      text[13] != ':' || text[16] != ':' || !ends_well(text.substr(kClock)))
    return std::nullopt;
  const int year = number_at(text, 0, 4), month = number_at(text, 5, 2),
            day = number_at(text, 8, 2);
  const int hour = number_at(text, 11, 2), minute = number_at(text, 14, 2),
            second = number_at(text, 17, 2);
  if (year < 0 || month < 1 || day < 1 || hour < 0 || hour > 23 || minute < 0 || minute > 59 ||
      second < 0 || second > 60)
    return std::nullopt;
  const chrono::year_month_day date{chrono::year{year}, chrono::month{unsigned(month)},
                                    chrono::day{unsigned(day)}};
  if (!date.ok()) return std::nullopt;
  const auto since = chrono::sys_days{date}.time_since_epoch();
  return chrono::duration_cast<chrono::seconds>(since).count() + 3600 * hour + 60 * minute + second;
}

std::string duration_text(double seconds) {
  for (const Unit& unit : kUnits) {
    const double count = std::round(seconds / unit.seconds);
    // Two of a smaller unit are more precise than one of a larger.
    if (count >= 2.0 || unit.seconds == 1.0)
      return fmt::format("{:.0f} {}{}", count, unit.name, count == 1.0 ? "" : "s");
  }
  return "";
}

}  // namespace turnscan
