#include <algorithm>
#include <array>
#include <turnscan/core/units.hpp>
#include <turnscan/io/text/table_text.hpp>
#include <turnscan/io/text/text_fields.hpp>

namespace turnscan::text {

namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF", kLittleMark = "\xFF\xFE",
                           kBigMark = "\xFE\xFF";
/// Units that may follow a name after an underscore.
constexpr std::array<std::string_view, 9> kUnits{"deg", "rad", "s",  "ms", "us",
                                                 "ns",  "m",   "mm", "cm"};

void append_utf8(std::uint32_t c, std::string& out) {
  const auto tail = [&](int shift) { out += char(0x80 | ((c >> shift) & 0x3F)); };
  if (c < 0x80) {
    out += char(c);
  } else if (c < 0x800) {
    out += char(0xC0 | c >> 6), tail(0);
  } else if (c < 0x10000) {
    out += char(0xE0 | c >> 12), tail(6), tail(0);
  } else {
    out += char(0xF0 | c >> 18), tail(12), tail(6), tail(0);
  }
}

Result<std::string> from_utf16(std::string_view bytes, bool big) {
  if (bytes.size() % 2 != 0) return fail(ErrorCode::kFormat, "its UTF-16 ends within a character");
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    const auto unit = [&](std::size_t at) {
      const auto first = std::uint8_t(bytes[at]), second = std::uint8_t(bytes[at + 1]);
      return std::uint32_t(big ? first << 8 | second : second << 8 | first);
    };
    std::uint32_t c = unit(i);
    if (c >= 0xD800 && c < 0xDC00 && i + 2 < bytes.size()) {
      i += 2;
      c = 0x10000 + ((c - 0xD800) << 10) + ((unit(i) - 0xDC00) & 0x3FF);
    }
    append_utf8(c, out);
  }
  return out;
}

std::string lower(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return out;
}

}  // namespace

Result<std::string> utf8_of(std::string_view bytes) {
  if (bytes.starts_with(kLittleMark) || bytes.starts_with(kBigMark))
    return from_utf16(bytes.substr(2), bytes.starts_with(kBigMark));
  if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
  if (bytes.find('\0') != std::string_view::npos)
    return fail(ErrorCode::kFormat, "this is not a text file; save the table as CSV (UTF-8)");
  return std::string(bytes);
}

char delimiter_of(std::string_view header_line) {
  char out = ',';
  std::ptrdiff_t most = 0;
  for (const char c : {';', '\t', ','}) {
    const auto count = std::count(header_line.begin(), header_line.end(), c);
    if (count > most) most = count, out = c;
  }
  return out;
}

Result<double> parse_decimal(std::string_view text) {
  if (auto value = parse_number(text)) return value;
  std::string point(text);
  std::replace(point.begin(), point.end(), ',', '.');
  if (auto value = parse_number(point)) return value;
  return parse_number(text);
}

ColumnName column_name(std::string_view text) {
  const std::string name = lower(trimmed(text));
  const std::size_t bracket = name.find_first_of("[(");
  if (bracket != std::string::npos) {
    const std::size_t end = std::min(name.find_first_of("])", bracket), name.size());
    std::string unit(trimmed(std::string_view(name).substr(bracket + 1, end - bracket - 1)));
    // The degree sign in UTF-8 and in Latin 1.
    if (unit == "\xC2\xB0" || unit == "\xB0" || unit == "degrees") unit = "deg";
    return {std::string(trimmed(name.substr(0, bracket))), unit};
  }
  const std::size_t line = name.rfind('_');
  if (line != std::string::npos &&
      std::find(kUnits.begin(), kUnits.end(), name.substr(line + 1)) != kUnits.end())
    return {name.substr(0, line), name.substr(line + 1)};
  return {name, ""};
}

}  // namespace turnscan::text
